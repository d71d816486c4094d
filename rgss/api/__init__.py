"""The public Python interface: a study as pandas frames and plots."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.api.study import Study
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "Study",
]
