"""Evidence store: SQLite file, ledger, verification, rescue, export and merge."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.evidence.store.census import numerics_census
    from rgss.evidence.store.collection import Garbage, collect_garbage, find_garbage
    from rgss.evidence.store.connection import error_of
    from rgss.evidence.store.contents import Contents, TrialName, contents_of, trial_names
    from rgss.evidence.store.exporting import export_trials, require_exportable
    from rgss.evidence.store.locking import folder_lock
    from rgss.evidence.store.merging import merge
    from rgss.evidence.store.observation import observed, state_of
    from rgss.evidence.store.store import EvidenceStore
    from rgss.evidence.store.verification import Verification, remove_damaged_rows, salvage, verify
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
