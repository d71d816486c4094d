"""The used names of the library ``reqif``, which is untyped and divided into many modules."""

from reqif.models.reqif_core_content import ReqIFCoreContent
from reqif.models.reqif_data_type import (
    ReqIFDataTypeDefinitionBoolean,
    ReqIFDataTypeDefinitionEnumeration,
    ReqIFDataTypeDefinitionString,
    ReqIFDataTypeDefinitionXHTML,
    ReqIFEnumValue,
)
from reqif.models.reqif_namespace_info import ReqIFNamespaceInfo
from reqif.models.reqif_req_if_content import ReqIFReqIFContent
from reqif.models.reqif_reqif_header import ReqIFReqIFHeader
from reqif.models.reqif_spec_hierarchy import ReqIFSpecHierarchy
from reqif.models.reqif_spec_object import ReqIFSpecObject, SpecObjectAttribute
from reqif.models.reqif_spec_object_type import ReqIFSpecObjectType, SpecAttributeDefinition
from reqif.models.reqif_spec_relation import ReqIFSpecRelation
from reqif.models.reqif_spec_relation_type import ReqIFSpecRelationType
from reqif.models.reqif_specification import ReqIFSpecification
from reqif.models.reqif_specification_type import ReqIFSpecificationType
from reqif.models.reqif_types import SpecObjectAttributeType
from reqif.object_lookup import ReqIFObjectLookup
from reqif.parser import ReqIFParser
from reqif.reqif_bundle import ReqIFBundle
from reqif.unparser import ReqIFUnparser

__all__ = [
    "ReqIFBundle",
    "ReqIFCoreContent",
    "ReqIFDataTypeDefinitionBoolean",
    "ReqIFDataTypeDefinitionEnumeration",
    "ReqIFDataTypeDefinitionString",
    "ReqIFDataTypeDefinitionXHTML",
    "ReqIFEnumValue",
    "ReqIFNamespaceInfo",
    "ReqIFObjectLookup",
    "ReqIFParser",
    "ReqIFReqIFContent",
    "ReqIFReqIFHeader",
    "ReqIFSpecHierarchy",
    "ReqIFSpecObject",
    "ReqIFSpecObjectType",
    "ReqIFSpecRelation",
    "ReqIFSpecRelationType",
    "ReqIFSpecification",
    "ReqIFSpecificationType",
    "ReqIFUnparser",
    "SpecAttributeDefinition",
    "SpecObjectAttribute",
    "SpecObjectAttributeType",
]
