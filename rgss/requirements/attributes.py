"""Enumerations of the attributes of needs and requirements."""

from __future__ import annotations

from enum import Enum


class NeedKind(str, Enum):
    """Subject of a stakeholder requirement: a part of the system."""

    DESIGN = "design"
    FUNCTIONAL = "functional"
    INTERFACE = "interface"
    PERFORMANCE = "performance"


class RequirementGroup(str, Enum):
    """Subject of a system requirement: a subsystem."""

    MANIPULATOR = "manipulator"
    GRIPPER = "gripper"
    ACTUATOR = "actuator"
    JOINT = "joint"
    PHYSICS = "physics"
    SCRIPT = "script"
    ALGORITHM = "algorithm"


class VerificationMethod(str, Enum):
    """Verification method of a requirement.

    Evidence from simulation is analysis in the sense of the NASA Systems Engineering Handbook and the INCOSE handbook;
    a test runs the product itself under controlled conditions. For a requirement on this software the product is the
    software, so its test suite is a test.
    """

    INSPECTION = "inspection"
    ANALYSIS = "analysis"
    DEMONSTRATION = "demonstration"
    TEST = "test"


class VerificationPhase(str, Enum):
    """Verification phase of a requirement (NASA Systems Engineering Handbook, table D-1)."""

    DEVELOPMENT = "development"
    QUALIFICATION = "qualification"
    ACCEPTANCE = "acceptance"
    OPERATION = "operation"


class Priority(str, Enum):
    """Priority of a requirement."""

    HIGH = "high"
    MEDIUM = "medium"
    LOW = "low"


class Status(str, Enum):
    """Maturity of a requirement."""

    DRAFT = "draft"
    PROPOSED = "proposed"
    APPROVED = "approved"
