"""Evidence values: records, pieces and provenance, with serialisation and digests."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.evidence.records.codec import plain_json, read_json, read_plain, record_from_json, record_to_json
    from rgss.evidence.records.digests import is_digest, record_digest, text_digest, trial_key
    from rgss.evidence.records.numerics import Numerics, numerics_difference, numerics_text, require_alike, results_of
    from rgss.evidence.records.origin import code_revision, file_digests, machine
    from rgss.evidence.records.outcomes import Failure, Fidelity, PhaseOutcome, PlanOutcome
    from rgss.evidence.records.packing import LARGEST_TEXT, unpack
    from rgss.evidence.records.pieces import Piece, PieceKind, piece_row, read_piece
    from rgss.evidence.records.planning_runs import PlanningRun
    from rgss.evidence.records.provenance import Provenance, provenance_from_json
    from rgss.evidence.records.records import Metric, PhaseRecord, PlanningRecord, TrialRecord
    from rgss.evidence.records.run_failures import RunFailure, RunFailureKind, detail_line, failure_row, read_failure
    from rgss.evidence.records.trial_inputs import TrialInputs, inputs_digest, inputs_row, read_inputs
    from rgss.evidence.records.trial_rows import StoredTrial, read_trial, require_key, trial_row
    from rgss.evidence.records.trial_trace import PhaseSpan, TrialTrace
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
