"""What trials leave behind: records, their digests, and the store that keeps them."""

from rgss.evidence.codec import plain_json, read_json, record_from_json, record_to_json
from rgss.evidence.digests import record_digest, text_digest, trial_key
from rgss.evidence.outcomes import PLANNED_PHASES, Failure, Fidelity, Phase, PhaseOutcome, PlanOutcome
from rgss.evidence.pieces import Piece, PieceKind
from rgss.evidence.provenance import Provenance
from rgss.evidence.records import Metric, PhaseRecord, PlanningRecord, TrialRecord
from rgss.evidence.run_failures import RunFailure, RunFailureKind
from rgss.evidence.store import EvidenceStore
from rgss.evidence.trial_inputs import inputs_digest
from rgss.evidence.trial_rows import StoredTrial

__all__ = [
    "PLANNED_PHASES",
    "EvidenceStore",
    "Failure",
    "Fidelity",
    "Metric",
    "Phase",
    "PhaseOutcome",
    "PhaseRecord",
    "Piece",
    "PieceKind",
    "PlanOutcome",
    "PlanningRecord",
    "Provenance",
    "RunFailure",
    "RunFailureKind",
    "StoredTrial",
    "TrialRecord",
    "inputs_digest",
    "plain_json",
    "read_json",
    "record_digest",
    "record_from_json",
    "record_to_json",
    "text_digest",
    "trial_key",
]
