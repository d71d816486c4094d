"""Verification evidence of the trace: verdicts, marked tests and their results."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.evidence.digest import verification_digest
    from rgss.trace.evidence.evidence_state import EvidenceState, FailedVerifications, TrialVerdicts
    from rgss.trace.evidence.junit_file import TEST_ID, VERIFIES, TestEnd, read_junit
    from rgss.trace.evidence.record_evidence import RecordEvidence, evidence_of_records
    from rgss.trace.evidence.record_writing import new_record, with_record, write_records
    from rgss.trace.evidence.software import (
        JUNIT_FILE,
        SoftwareEvidence,
        TestEvidence,
        run_properties,
        software_digest,
        software_evidence,
        tested_files,
    )
    from rgss.trace.evidence.test_marks import MarkedTest, marked_tests
    from rgss.trace.evidence.verdict_evidence import KEY_DIGITS, TraceEvidence, TrialEvidence, VariantEvidence
    from rgss.trace.evidence.verification import VerificationRow, success_criterion, verification_matrix
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
