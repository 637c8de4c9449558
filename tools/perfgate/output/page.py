"""The frame of every HTML page: one file, no script, nothing fetched; light, dark, phone and paper."""

from __future__ import annotations

from html import escape

CSS = """
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #59636e; --paper: #ffffff;
  --line: #d5dae0; --band: #e7f1e9; --red: #b3261e; --amber: #8a5a00; --green: #1a6b34;
  --blue: #1f5fa8; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ec; --soft: #9aa5b0; --paper: #14181c;
  --line: #333a42; --band: #1d2f24; --red: #ff8a80; --amber: #f0b95a; --green: #7fd394;
  --blue: #84b6f2; } }
* { box-sizing: border-box; }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 72rem; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.3rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }
h2 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p, dl { margin: .4rem 0; } .soft { color: var(--soft); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
th, td { text-align: left; padding: .25rem .6rem .25rem 0; border-bottom: 1px solid var(--line);
  vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
code { font-size: .92em; overflow-wrap: anywhere; }
.ERROR, .REGRESSION { color: var(--red); font-weight: 600; }
.WAIVED, .LAYOUT_SENSITIVE, .SMALL_SLOWDOWN, .UNSTABLE, .INCONCLUSIVE { color: var(--amber); }
.IMPROVEMENT, .OK { color: var(--green); font-weight: 600; }
details { border-bottom: 1px solid var(--line); padding: .3rem 0; }
summary { cursor: pointer; overflow-wrap: anywhere; }
svg { width: 100%; max-width: 640px; height: auto; display: block; margin: .3rem 0; }
svg text { font: 11px system-ui, sans-serif; fill: var(--soft); }
.band { fill: var(--band); } .grid { stroke: var(--line); } .zero { stroke: var(--soft); }
.dot { fill: var(--blue); fill-opacity: .55; } .interval { stroke: var(--ink); stroke-width: 3; }
.estimate { stroke: var(--red); stroke-width: 3; } .change { stroke: var(--red); }
polyline { fill: none; stroke-width: 1.6; } .base { stroke: var(--soft); }
.head { stroke: var(--blue); }
@media print { body { max-width: none; padding: 0; font-size: 11px; }
  details { break-inside: avoid; } :root { --paper: #ffffff; --ink: #000000; } }
"""


def page(title: str, body: str) -> str:
    return ('<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(title)}</title>\n<style>{CSS}</style>\n</head>\n<body>\n{body}\n"
            "</body>\n</html>\n")
