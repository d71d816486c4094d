"""Evidence of trials: records, their digests and the evidence store."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.evidence.records import (
        Failure,
        Fidelity,
        Metric,
        PhaseOutcome,
        PhaseRecord,
        Piece,
        PieceKind,
        PlanningRecord,
        PlanOutcome,
        Provenance,
        RunFailure,
        RunFailureKind,
        StoredTrial,
        TrialRecord,
        inputs_digest,
        read_json,
        record_digest,
        record_from_json,
        record_to_json,
        text_digest,
        trial_key,
    )
    from rgss.evidence.store import EvidenceStore
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
