"""Payload bench: the greatest mass that a gripper holds under acceleration."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.payload_bench.bench import PayloadResult, run_bench
    from rgss.trials.payload_bench.of_trial import bench_of, payload_bench
    from rgss.trials.payload_bench.range import outside
    from rgss.trials.payload_bench.spec import BenchSpec, bench_spec
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
