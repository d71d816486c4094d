"""Assessment of a study: estimates and verdicts from trial records, and their staleness."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.assessment.estimate_bounds import IN_COMMON, EstimateBounds, bounds_by_measure
    from rgss.assessment.evidence_status import evidence_state, failed_verifications, project_marks, verification_files
    from rgss.assessment.failure_drivers import (
        Aspect,
        Driver,
        DriversOfFailures,
        FailureDrivers,
        drivers_of_failures,
    )
    from rgss.assessment.measuring import (
        VariantMeasures,
        judged_measures,
        leading_measures,
        measure_variants,
        require_complete,
        requirements_with_criteria,
        verdicts_on,
    )
    from rgss.assessment.recorded_verdicts import VERDICT_FILE, VerdictRecord, read_record
    from rgss.assessment.recording import record_after_sweep, record_before_sweep, record_verdicts
    from rgss.assessment.remedies import stale_remedies
    from rgss.assessment.replicates import common_seeds, replicates_of, specs_read
    from rgss.assessment.seed_groups import SeedGroup, sequential_seeds
    from rgss.assessment.stored_replicates import read_specs
    from rgss.assessment.workload_cases import CaseSuccess, measured_in_case, success_by_case
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
