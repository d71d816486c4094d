"""What trials leave behind: records, their digests, and the store that keeps them."""

from rgss.evidence.codec import record_from_json, record_to_json
from rgss.evidence.digests import record_digest, trial_key
from rgss.evidence.outcomes import PLANNED_PHASES, Failure, Fidelity, Phase, PhaseOutcome, PlanOutcome
from rgss.evidence.provenance import Provenance
from rgss.evidence.records import Metric, PhaseRecord, PlanningRecord, TrialRecord
from rgss.evidence.store import EvidenceStore, StoredTrial

__all__ = [
    "PLANNED_PHASES",
    "EvidenceStore",
    "Failure",
    "Fidelity",
    "Metric",
    "Phase",
    "PhaseOutcome",
    "PhaseRecord",
    "PlanOutcome",
    "PlanningRecord",
    "Provenance",
    "StoredTrial",
    "TrialRecord",
    "record_digest",
    "record_from_json",
    "record_to_json",
    "trial_key",
]
