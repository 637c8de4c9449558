#pragma once

namespace hedgerow::tool {

/// Colours are named once for light and once for dark; paper is always light. On a phone the label
/// of a bar stands above it.
inline constexpr const char* kReportStyle = R"css(
:root{color-scheme:light dark;--paper:#fbfbfa;--card:#fff;--ink:#1d2430;--soft:#5d6878;
--line:#e2e5ea;--bar:#4a9a72;--bar2:#b9c3d0;--good:#2f7d4f;--bad:#b3261e}
@media (prefers-color-scheme:dark){:root{--paper:#14171c;--card:#1b2027;--ink:#e6e9ee;
--soft:#98a3b3;--line:#2c333d;--bar:#58b287;--bar2:#4d5866;--good:#7fd0a4;--bad:#ff8a80}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
main{max-width:66rem;margin:0 auto;padding:1.5rem 1rem 4rem}
h1{font-size:1.7rem;line-height:1.2;margin:.2em 0;overflow-wrap:anywhere}
h2{font-size:1.15rem;margin:2.4rem 0 .6rem}
p{margin:.4rem 0}.soft{color:var(--soft);font-size:.9rem}
.good{color:var(--good);font-weight:600}.bad{color:var(--bad);font-weight:600}
img{display:block;width:100%;height:auto;border-radius:.6rem;border:1px solid var(--line)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(9rem,1fr));gap:.7rem;margin:1rem 0}
.tile{background:var(--card);border:1px solid var(--line);border-radius:.6rem;padding:.7rem .9rem}
.tile b{display:block;font-size:1.35rem;font-variant-numeric:tabular-nums}
.tile span{color:var(--soft);font-size:.85rem}
.wide{overflow-x:auto;background:var(--card);border:1px solid var(--line);border-radius:.6rem}
table{border-collapse:collapse;width:100%;font-size:.84rem;font-variant-numeric:tabular-nums}
th,td{padding:.35rem .5rem;text-align:right;white-space:nowrap;border-top:1px solid var(--line)}
thead th{border-top:0;color:var(--soft);font-weight:600;white-space:normal;vertical-align:bottom}
th:first-child,td:first-child,.word{text-align:left}
.facts td:last-child{text-align:left;white-space:normal}
.plot{display:grid;grid-template-columns:17rem 1fr 4.2rem;gap:.25rem .7rem;
align-items:center;font-size:.88rem}
.plot svg{width:100%;height:1.1rem;display:block}
.plot i{font-style:normal;text-align:right;font-variant-numeric:tabular-nums}
.bar{fill:var(--bar)}.bar2{fill:var(--bar2)}.axis{stroke:var(--line);stroke-width:.3}
@media (max-width:44rem){body{font-size:15px}h1{font-size:1.35rem}
.plot{grid-template-columns:1fr 3.6rem;gap:0 .7rem}.plot span{grid-column:1/-1;margin-top:.35rem}}
@media print{:root{--paper:#fff;--card:#fff;--ink:#000;--soft:#444;--line:#bbb;
--bar:#4a9a72;--bar2:#bbb;--good:#000;--bad:#000}body{font-size:10pt}main{max-width:none;padding:0}
.wide{overflow:visible;border:0}table{font-size:7.5pt}th,td{padding:.15rem .3rem}
h2{break-after:avoid}.plot,tr,img{break-inside:avoid}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)css";

}  // namespace hedgerow::tool
