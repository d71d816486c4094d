"""Reviews: the content that was read, by whom, and the content that it depended on then."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Review:
    """The stamp of one element.

    Attributes:
        id: The element.
        digest: Content digest of the element when it was reviewed.
        upstream: Content digests, at that time, of the elements that it depends on.
        reviewer: Who reviewed it.
    """

    id: str
    digest: str
    upstream: Mapping[str, str]
    reviewer: str
