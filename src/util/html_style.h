// The style sheet of every page: system fonts, one column, light and dark, from 400 pixels of width on.
#pragma once

namespace etendue
{
inline constexpr const char* HTML_STYLE = R"(:root {
  --paper: #fdfdfc; --ink: #1c1e21; --soft: #5b6068; --line: #dcdee2; --panel: #f3f4f5; --link: #0b5fae;
  --good: #0a6b3d; --good-paper: #e6f4ec; --bad: #a4262c; --bad-paper: #fbeaea; --caution: #7a5200;
  --caution-paper: #fdf3dc; --shade: rgba(20, 24, 32, .28);
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #15171a; --ink: #e6e7e9; --soft: #a3a9b3; --line: #363a41; --panel: #1f2226; --link: #7cb8f2;
    --good: #6fd39b; --good-paper: #14291e; --bad: #ff9a94; --bad-paper: #331a1b; --caution: #f0c463;
    --caution-paper: #2e2512; --shade: rgba(0, 0, 0, .75);
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", "Helvetica Neue", "DejaVu Sans", Arial, sans-serif;
}
main, footer { max-width: 1120px; margin: 0 auto; padding: 0 28px; }
main { padding-top: 36px; }
footer { padding-top: 12px; padding-bottom: 36px; color: var(--soft); font-size: 13px; }
h1 { font-size: 30px; line-height: 1.2; letter-spacing: -.015em; margin: 0 0 20px; overflow-wrap: anywhere; }
h2 {
  font-size: 20px; line-height: 1.3; margin: 44px 0 14px; padding-bottom: 6px; border-bottom: 1px solid var(--line);
  overflow-wrap: anywhere;
}
h3 { font-size: 16px; margin: 26px 0 8px; }
p { margin: 0 0 12px; max-width: 75ch; overflow-wrap: anywhere; }
a { color: var(--link); }
.verdict {
  display: flex; gap: 16px; align-items: flex-start; padding: 16px 20px; margin: 0 0 20px;
  border: 1px solid currentColor; border-left-width: 6px; border-radius: 6px;
}
.verdict strong { display: block; font-size: 20px; line-height: 1.3; overflow-wrap: anywhere; }
.verdict p { color: var(--ink); margin: 4px 0 0; }
.verdict .icon { font-size: 26px; line-height: 1; font-weight: 700; min-width: 26px; text-align: center; }
.verdict > div { min-width: 0; }
.good { color: var(--good); } .bad { color: var(--bad); } .caution { color: var(--caution); }
.verdict.good { background: var(--good-paper); }
.verdict.bad { background: var(--bad-paper); }
.verdict.caution { background: var(--caution-paper); }
.mark { font-weight: 600; white-space: nowrap; }
.scroll {
  overflow-x: auto; max-width: 100%; margin: 0 0 18px; scrollbar-width: thin;
  background:
    linear-gradient(to right, var(--paper) 30%, transparent) left / 40px 100% no-repeat local,
    linear-gradient(to left, var(--paper) 30%, transparent) right / 40px 100% no-repeat local,
    linear-gradient(to right, var(--shade), transparent) left / 14px 100% no-repeat scroll,
    linear-gradient(to left, var(--shade), transparent) right / 14px 100% no-repeat scroll;
}
.scroll:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
table { border-collapse: collapse; font-size: 15px; line-height: 1.4; min-width: min(100%, 420px); }
caption { text-align: left; color: var(--soft); font-size: 14px; padding: 0 0 8px; }
th, td { padding: 7px 24px 7px 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th:last-child, td:last-child { padding-right: 2px; }
thead th {
  font-size: 13px; font-weight: 600; color: var(--soft); border-bottom: 2px solid var(--line); white-space: nowrap;
  vertical-align: bottom;
}
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
dl { margin: 0 0 18px; display: grid; grid-template-columns: minmax(0, max-content) minmax(0, 1fr); font-size: 15px; }
dl > div { display: contents; }
dt, dd { margin: 0; padding: 7px 0; border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
dt { color: var(--soft); padding-right: 32px; }
dd { font-variant-numeric: tabular-nums; }
pre {
  margin: 0 0 18px; padding: 12px 16px; background: var(--panel); border: 1px solid var(--line); border-radius: 6px;
  white-space: pre-wrap; overflow-wrap: anywhere;
}
code, pre { font: 13.5px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
figure { margin: 0; min-width: 0; }
figcaption { color: var(--soft); font-size: 14px; line-height: 1.45; padding-top: 8px; overflow-wrap: anywhere; }
.figures {
  display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 300px), 1fr)); gap: 28px 24px;
  margin: 0 0 22px; align-items: start;
}
.figures figure { max-width: 620px; }
.figures img { display: block; width: 100%; height: auto; background: var(--panel); border-radius: 3px; }
.figures img.pixels { image-rendering: pixelated; }
.drawing { margin: 0 0 24px; }
.drawing .scroll { margin: 0; }
.drawing svg { display: block; width: 100%; height: auto; min-width: 600px; max-width: 860px; }
.drawing svg.small { min-width: 340px; max-width: 560px; }
.scale { display: block; margin-top: 8px; }
.scale .bar { display: block; height: 10px; border-radius: 2px; border: 1px solid var(--line); }
.scale .ends { display: flex; justify-content: space-between; gap: 8px; font-size: 13px; }
@media (max-width: 640px) {
  main, footer { padding-left: 16px; padding-right: 16px; }
  main { padding-top: 22px; }
  h1 { font-size: 25px; }
  h2 { margin-top: 34px; }
  .verdict { padding: 14px; gap: 12px; }
  th, td { padding-right: 18px; }
  dl { grid-template-columns: minmax(0, 1fr); }
  dt { border-bottom: 0; padding-bottom: 0; font-size: 14px; }
  dd { padding-top: 1px; }
}
@media print {
  body { font-size: 11pt; }
  section, figure, table { break-inside: avoid; }
}
)";
} // namespace etendue
