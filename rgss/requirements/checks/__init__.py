"""Consistency checks of behaviours and of references."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.requirements.checks.behaviour import check_behaviours
    from rgss.requirements.checks.declarations import declared_elements, declared_needs, declared_requirements
    from rgss.requirements.checks.structure import check_blocks
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
