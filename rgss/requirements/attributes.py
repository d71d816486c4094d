"""The closed lists that the attributes of needs and requirements choose from."""

from __future__ import annotations

from enum import Enum


class NeedKind(str, Enum):
    """The part of the system that a stakeholder requirement speaks of."""

    DESIGN = "design"
    FUNCTIONAL = "functional"
    INTERFACE = "interface"
    PERFORMANCE = "performance"


class RequirementGroup(str, Enum):
    """The subsystem that a system requirement speaks of."""

    MANIPULATOR = "manipulator"
    GRIPPER = "gripper"
    ACTUATOR = "actuator"
    JOINT = "joint"
    PHYSICS = "physics"
    SCRIPT = "script"
    ALGORITHM = "algorithm"


class VerificationMethod(str, Enum):
    """How it is shown that a requirement is met.

    Evidence from simulation is analysis in the sense of the NASA Systems Engineering Handbook
    and the INCOSE handbook: test means that the product itself ran under controlled conditions.
    For a requirement on this software the product is the software, so its test suite is a test.
    """

    INSPECTION = "inspection"
    ANALYSIS = "analysis"
    DEMONSTRATION = "demonstration"
    TEST = "test"


class VerificationPhase(str, Enum):
    """When it is shown that a requirement is met (NASA Systems Engineering Handbook, table D-1)."""

    DEVELOPMENT = "development"
    QUALIFICATION = "qualification"
    ACCEPTANCE = "acceptance"
    OPERATION = "operation"


class Priority(str, Enum):
    """How much it matters that a requirement is met."""

    HIGH = "high"
    MEDIUM = "medium"
    LOW = "low"


class Status(str, Enum):
    """How far a requirement has come."""

    DRAFT = "draft"
    PROPOSED = "proposed"
    APPROVED = "approved"
