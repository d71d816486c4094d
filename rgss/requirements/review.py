"""Reviews: reviewed content, reviewer, and the upstream content at that time."""

from __future__ import annotations

from typing import Annotated

from pydantic import StringConstraints
from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text

ContentDigest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
"""A SHA-256 in hexadecimal digits."""


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Review:
    """The review of one element, in ``reviews.yaml``."""

    digest: ContentDigest
    reviewer: Text
    upstream: dict[Identifier, ContentDigest]
