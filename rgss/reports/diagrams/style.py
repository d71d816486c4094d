"""Style sheet of diagrams, for pages and for files."""

from __future__ import annotations

FONT = 13.5
"""Size of names, in pixels."""
SMALL = 12.0
"""Size of texts, labels and stereotypes, in pixels; diagrams are shown at full size, so it is legible there."""
LINE = 1.3
"""Line height, in font sizes."""

STYLE = """\
svg.rgss-diagram { --d-paper: #ffffff; --d-ink: #1b1f24; --d-soft: #57606a; --d-box: #f4f6f9; --d-need: #fdf3d8;
  --d-requirement: #e3effc; --d-behaviour: #e6f4ea; --d-measure: #f3e8f7; --d-fail: #fbe4d8;
  background: #ffffff; background: var(--d-paper); font-family: "DejaVu Sans", Verdana, Geneva, sans-serif; }
@media (prefers-color-scheme: dark) { svg.rgss-diagram { --d-paper: #12161c; --d-ink: #e6e9ee; --d-soft: #a4aebb;
  --d-box: #222a35; --d-need: #3d3413; --d-requirement: #17324f; --d-behaviour: #173a26; --d-measure: #3a2746;
  --d-fail: #4c2413; } }
@media print { svg.rgss-diagram { --d-paper: #ffffff; --d-ink: #000000; --d-soft: #333333; --d-box: #ffffff;
  --d-need: #ffffff; --d-requirement: #ffffff; --d-behaviour: #ffffff; --d-measure: #ffffff; --d-fail: #ffffff; } }
.rgss-diagram .paper { fill: var(--d-paper); stroke: none; }
.rgss-diagram text { fill: var(--d-ink); font-size: 12px; white-space: pre; }
.rgss-diagram text.name { font-size: 13.5px; font-weight: bold; }
.rgss-diagram text.plain { font-size: 13.5px; }
.rgss-diagram text.soft { fill: var(--d-soft); }
.rgss-diagram text.italic { font-style: italic; }
.rgss-diagram text.label { paint-order: stroke; stroke: var(--d-paper); stroke-width: 3px; stroke-linejoin: round; }
.rgss-diagram .shape { fill: var(--d-box); stroke: var(--d-ink); stroke-width: 1.1; }
.rgss-diagram .need { fill: var(--d-need); }
.rgss-diagram .requirement { fill: var(--d-requirement); }
.rgss-diagram .behaviour { fill: var(--d-behaviour); }
.rgss-diagram .measure { fill: var(--d-measure); }
.rgss-diagram .fail { fill: var(--d-fail); stroke-dasharray: 5 3; }
.rgss-diagram .value { fill: var(--d-need); }
.rgss-diagram .open { fill: none; }
.rgss-diagram .solid { fill: var(--d-ink); stroke: var(--d-ink); }
.rgss-diagram .hollow { fill: var(--d-paper); stroke: var(--d-ink); stroke-width: 1.1; }
.rgss-diagram .line { fill: none; stroke: var(--d-ink); stroke-width: 1.1; }
.rgss-diagram .dashed { stroke-dasharray: 6 4; }
.rgss-diagram .dotted { stroke-dasharray: 2 4; stroke: var(--d-soft); }
.rgss-diagram .thin { stroke-width: 0.7; }
"""
