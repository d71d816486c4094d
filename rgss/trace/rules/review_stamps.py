"""Stamping of reviews; no other option of the check writes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from rgss.documents import write_small_source
from rgss.errors import DefinitionError
from rgss.requirements import RequirementSet, Review
from rgss.trace.rules.upstream import upstream_of_each

REVIEWS = "reviews.yaml"
"""The file in the requirements folder."""

EVERYTHING = "all"
"""Stands for every stakeholder and system requirement, and every other element that has a review already."""

LONGEST_REVIEWER = 80

_HEAD = "# Written by 'rgss check --review'; what was reviewed is told by SHA-256 of its content.\n"


def expanded(requirements: RequirementSet, ids: Sequence[str]) -> tuple[str, ...]:
    """The ids of elements, each once, with `EVERYTHING` in full.

    Args:
        requirements: The requirements, with the reviews so far.
        ids: Ids of elements; `EVERYTHING` for all.

    Raises:
        DefinitionError: An id names nothing; the hint names the nearest one.
    """
    found: dict[str, None] = {}
    for each in ids:
        if each == EVERYTHING:
            found.update(dict.fromkeys(need.id for need in requirements.stakeholder))
            found.update(dict.fromkeys(requirement.id for requirement in requirements.system))
            found.update(dict.fromkeys(name for name in requirements.reviews if name in requirements.places))
        else:
            found[requirements.element(each).id] = None
    return tuple(found)


def stamped(requirements: RequirementSet, ids: Sequence[str], reviewer: str) -> Mapping[str, Review]:
    """Reviews of a project after some of its elements were reviewed.

    Args:
        requirements: The requirements, with the reviews so far.
        ids: Ids of the elements that were read; `EVERYTHING` for all.
        reviewer: Who read them.

    Returns:
        Every review by id, sorted. Reviews of elements that are gone are left out.

    Raises:
        DefinitionError: An id names nothing, or the reviewer's name is not a single line of text.
    """
    name = " ".join(reviewer.split())
    if not name or len(name) > LONGEST_REVIEWER or not name.isprintable():
        raise DefinitionError(
            f"a reviewer is named by 1 to {LONGEST_REVIEWER} printable characters", hint="give --reviewer NAME"
        )
    kept = {one: review for one, review in requirements.reviews.items() if one in requirements.places}
    upstream = upstream_of_each(requirements)
    digest_of = lru_cache(maxsize=None)(requirements.content_digest)
    for each in expanded(requirements, ids):
        kept[each] = Review(
            digest=digest_of(each),
            upstream={link.target: digest_of(link.target) for link in upstream[each]},
            reviewer=name,
        )
    return dict(sorted(kept.items()))


def write_reviews(folder: Path, reviews: Mapping[str, Review]) -> Path:
    """Write the reviews atomically.

    Args:
        folder: The requirements folder.
        reviews: Every review by id.

    Returns:
        The file.

    Raises:
        DefinitionError: The file would exceed the size limit of the reader, or the folder cannot be written.
        StorageError: The disk is full.
    """
    text, holds = reviews_yaml(reviews), f"{len(reviews)} reviews"
    return write_small_source(folder / REVIEWS, text, holds=holds, hint="review fewer elements")


def reviews_yaml(reviews: Mapping[str, Review]) -> str:
    """Canonical text of some reviews, independent of their order."""
    if not reviews:
        return f"{_HEAD}reviews: {{}}\n"
    lines = [_HEAD, "reviews:\n"]
    for name, review in sorted(reviews.items()):
        lines.append(f'  {name}:\n    digest: "{review.digest}"\n    reviewer: {_quoted(review.reviewer)}\n')
        if review.upstream:
            lines.append("    upstream:\n")
            lines += [f'      {target}: "{digest}"\n' for target, digest in sorted(review.upstream.items())]
        else:
            lines.append("    upstream: {}\n")
    return "".join(lines)


def _quoted(text: str) -> str:
    """A printable text as a double-quoted scalar of YAML."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
