"""Rules for the wording of requirements, with their word lists."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.rules.wording.all_rules import WORDING_RULES
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
