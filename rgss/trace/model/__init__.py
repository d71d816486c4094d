"""The trace graph of needs, requirements, measures, architecture and designs."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.model.measure_trace import MeasureKind, MeasureTrace
    from rgss.trace.model.model import TraceModel, build_trace_model
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
