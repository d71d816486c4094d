"""Fingerprint of the code, engine versions and numeric environment of a trial."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.code.code_fingerprint import source_digest
    from rgss.trials.code.kernel_environment import (
        ONE_THREAD,
        is_in_force,
        numeric_environment,
        numeric_environment_of_children,
        problem_here,
    )
    from rgss.trials.code.numeric_probe import fixed_numerics, numerics
    from rgss.trials.code.piece_versions import (
        ENTRIES,
        are_of_this_kind,
        assume_engines,
        code_of_trials,
        versions,
        versions_of,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
