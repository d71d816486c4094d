"""Actions of ``rgss evidence``."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.evidence.collection import collect
    from rgss.cli.evidence.merging import merge_evidence
    from rgss.cli.evidence.place import EvidencePlace
    from rgss.cli.evidence.summary import summarise
    from rgss.cli.evidence.verification import verify_evidence
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
