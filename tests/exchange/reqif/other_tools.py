"""Files of ReqIF as other tools write them, by hand."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

NAMESPACE = "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"
_TIME = 'LAST-CHANGE="2024-01-01T00:00:00Z"'


def reqif_of(types, objects, *, tool="DOORS", choices=None, hierarchy="", relations="", relation_types=""):
    """A file with types, each of attributes as ``(name, kind)``, and with objects as ``(type, values)``.

    A value of an enumeration is a list of choices; choices are those of each attribute by its name.
    """
    choices = choices or {}
    kinds = {"STRING", "XHTML", *(kind for attributes in types.values() for _, kind in attributes)}
    data = "".join(
        f"<DATATYPE-DEFINITION-{kind} IDENTIFIER={_id('d', kind)} {_TIME}/>" for kind in sorted(kinds - {"ENUMERATION"})
    )
    data += "".join(
        f"<DATATYPE-DEFINITION-ENUMERATION IDENTIFIER={_id('d', name)} {_TIME}><SPECIFIED-VALUES>"
        + "".join(
            f"<ENUM-VALUE IDENTIFIER={_id('e', name, each)} LONG-NAME={quoteattr(each)} {_TIME}><PROPERTIES>"
            f'<EMBEDDED-VALUE KEY="{number}" OTHER-CONTENT=""/></PROPERTIES></ENUM-VALUE>'
            for number, each in enumerate(known)
        )
        + "</SPECIFIED-VALUES></DATATYPE-DEFINITION-ENUMERATION>"
        for name, known in choices.items()
    )
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<REQ-IF xmlns="{NAMESPACE}" '
        f'xmlns:xhtml="http://www.w3.org/1999/xhtml"><THE-HEADER><REQ-IF-HEADER IDENTIFIER="_h">'
        f"<CREATION-TIME>2024-01-01T00:00:00Z</CREATION-TIME><REQ-IF-TOOL-ID>{tool}</REQ-IF-TOOL-ID>"
        f"<REQ-IF-VERSION>1.0</REQ-IF-VERSION><SOURCE-TOOL-ID>{tool}</SOURCE-TOOL-ID><TITLE>t</TITLE>"
        f"</REQ-IF-HEADER></THE-HEADER><CORE-CONTENT><REQ-IF-CONTENT><DATATYPES>{data}</DATATYPES>\n<SPEC-TYPES>"
        + "".join(_type(name, attributes) for name, attributes in types.items())
        + f"{relation_types}</SPEC-TYPES>\n<SPEC-OBJECTS>\n"
        + "\n".join(_object(number, name, types[name], values) for number, (name, values) in enumerate(objects))
        + f"\n</SPEC-OBJECTS><SPEC-RELATIONS>{relations}</SPEC-RELATIONS><SPECIFICATIONS>{hierarchy}</SPECIFICATIONS>"
        "</REQ-IF-CONTENT></CORE-CONTENT></REQ-IF>\n"
    )


def _id(*parts):
    return quoteattr("_" + "-".join(each.replace(" ", "_") for each in parts))


def _type(name, attributes):
    inner = "".join(
        f"<ATTRIBUTE-DEFINITION-{kind} IDENTIFIER={_id('a', name, long)} LONG-NAME={quoteattr(long)} {_TIME}><TYPE>"
        f"<DATATYPE-DEFINITION-{kind}-REF>{_id('d', long if kind == 'ENUMERATION' else kind)[1:-1]}"
        f"</DATATYPE-DEFINITION-{kind}-REF></TYPE></ATTRIBUTE-DEFINITION-{kind}>"
        for long, kind in attributes
    )
    return (
        f"<SPEC-OBJECT-TYPE IDENTIFIER={_id('t', name)} LONG-NAME={quoteattr(name)} {_TIME}>"
        f"<SPEC-ATTRIBUTES>{inner}</SPEC-ATTRIBUTES></SPEC-OBJECT-TYPE>"
    )


def _object(number, name, attributes, values):
    kinds = dict(attributes)
    inner = "".join(_value(name, long, kinds[long], value) for long, value in values.items())
    return (
        f'<SPEC-OBJECT IDENTIFIER="_o{number}" {_TIME}><TYPE><SPEC-OBJECT-TYPE-REF>{_id("t", name)[1:-1]}'
        f"</SPEC-OBJECT-TYPE-REF></TYPE><VALUES>{inner}</VALUES></SPEC-OBJECT>"
    )


def _value(type_name, long, kind, value):
    place = _id("a", type_name, long)[1:-1]
    definition = f"<DEFINITION><ATTRIBUTE-DEFINITION-{kind}-REF>{place}</ATTRIBUTE-DEFINITION-{kind}-REF></DEFINITION>"
    if kind == "ENUMERATION":
        chosen = "".join(f"<ENUM-VALUE-REF>{_id('e', long, each)[1:-1]}</ENUM-VALUE-REF>" for each in value)
        inner, stated = f"<VALUES>{chosen}</VALUES>", ""
    elif kind == "XHTML":
        rich = value if value.startswith("<") else f"<xhtml:div>{escape(value)}</xhtml:div>"
        inner, stated = f"<THE-VALUE>{rich}</THE-VALUE>", ""
    else:
        inner, stated = "", f" THE-VALUE={quoteattr(value)}"
    return f"<ATTRIBUTE-VALUE-{kind}{stated}>{definition}{inner}</ATTRIBUTE-VALUE-{kind}>"
