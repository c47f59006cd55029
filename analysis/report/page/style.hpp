#pragma once

#include <string_view>

namespace drift::report {

/// The look of every page: light or dark as the reader's system is, light on paper. Figures keep
/// their size, so that their text stays readable; a window narrower than 860 px and its margins
/// gets those that were drawn for it, one narrower than these scales them, but text of 12 px to no
/// less than 8. Paper has them at 0.78 of their size, where text of 12 px is 7 pt, if they are not
/// higher than a sheet (--drawn: the width of a drawing). A dark page turns their lightness and
/// keeps their hues.
inline constexpr std::string_view page_style = R"css(
:root { color-scheme: light dark; --ink: #222; --dim: #555; --paper: #fff; --edge: #ccc;
        --soft: #f7f7f7; --head: #e9eef4; --box: #f3f6fa; --accent: #0072B2;
        --good: #00664d; --doubtful: #8a5a00; --bad: #b03000; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e2e2e2; --dim: #b0b0b0; --paper: #1c1c1c; --edge: #555; --soft: #242424;
          --head: #2b333c; --box: #232a32; --accent: #56B4E9;
          --good: #5fd0a5; --doubtful: #f0b75e; --bad: #ff9470; }
  figure svg, .zoomed { filter: invert(.89) hue-rotate(180deg); }
}
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: var(--ink); background: var(--paper);
       margin: 0 auto; padding: 1.5rem; max-width: 1180px; }
h1 { font-size: 1.6rem; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 2rem 0 .6rem; border-bottom: 1px solid var(--edge); }
h3 { font-size: 1.05rem; margin: 1.4rem 0 .4rem; overflow-wrap: anywhere; }
p, li { overflow-wrap: anywhere; }
.subtitle, .note, figcaption, footer { color: var(--dim); font-size: .9rem;
                                       overflow-wrap: anywhere; }
.answer { background: var(--box); border-left: 8px solid var(--accent); padding: .7rem 1rem;
          margin: 1rem 0; overflow-wrap: anywhere; }
.answer.good { color: inherit; border-color: var(--good); }
.answer.doubtful { color: inherit; border-color: var(--doubtful); }
.answer.bad { color: inherit; border-color: var(--bad); font-weight: inherit; }
.answer p { margin: .3rem 0; } .answer ul { margin: .3rem 0; padding-left: 1.3rem; }
.verdict { font-size: 1.1rem; } .next { font-weight: bold; }
.small { color: var(--dim); font-size: .82rem; }
.scroll { overflow-x: auto; } .narrow { display: none; }
@media screen and (max-width: 908px) { .scroll.roomy { display: none; } .narrow { display: block; } }
@media screen and (max-width: 588px) {
  body { padding: .75rem; }
  .scroll > svg, .head > svg { max-width: 100%; height: auto;
                               min-width: calc(var(--drawn) * .667px); }
}
table { border-collapse: collapse; font-size: .86rem; margin: .8rem 0 .3rem;
        font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: bold; padding-bottom: .3rem; }
th, td { padding: .16rem .65rem; white-space: nowrap; }
thead th { border-bottom: 2px solid var(--edge); }
tbody tr:nth-child(even) { background: var(--soft); }
tbody th { font-weight: normal; font-style: italic; color: var(--dim); background: var(--head);
           white-space: normal; }
.left { text-align: left; } .right { text-align: right; }
td.left { white-space: normal; overflow-wrap: break-word; } td.remark { min-width: min(16em, 40vw); }
.good { color: var(--good); } .doubtful { color: var(--doubtful); }
.bad { color: var(--bad); font-weight: bold; }
figure { margin: 1rem 0; } figure svg { display: block; }
.panels { display: flex; flex-wrap: wrap; } .panels > svg { flex-shrink: 0; } .panels > .head { flex-basis: 100%; overflow-x: auto; }
figure button { font: inherit; font-size: .85rem; } .replaced { display: none; }
.zoomed { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr));
          gap: 1rem; background: #fff; color: #333; }
.zoomed[hidden] { display: none; } .zoomed > div { height: 260px; min-width: 0; }
pre { font-size: .82rem; overflow-x: auto; background: var(--soft); padding: .8rem; }
details { margin: .4rem 0; } details details { padding-left: .8rem; }
summary { cursor: pointer; color: var(--accent); font-weight: bold; }
@page { size: A4; margin: 12mm; }
@page sideways { size: A4 landscape; }
@media print {
  body { max-width: none; padding: 0; font-size: 9pt; line-height: 1.4; }
  figure button, figure .note, .zoomed { display: none; } .replaced { display: block; }
  .answer, figure, tr, section > .scroll { break-inside: avoid; }
  h2, h3, summary { break-after: avoid; }
  .scroll { overflow: visible; } 
  .wide, :is(h2, h3, summary):has(+ .wide), h2:has(+ h3 + .wide) { page: sideways; }
  h1 { font-size: 15pt; } h2 { font-size: 12.5pt; margin: 10pt 0 3pt; }
  h3 { font-size: 10.5pt; margin: 7pt 0 2pt; } p, ul { margin: 3pt 0; }
  .verdict { font-size: 10pt; } .answer { padding: 4pt 8pt; margin: 6pt 0; }
  .subtitle, .note, .small, figcaption, footer { font-size: 8.5pt; }
  details:not([open]) { display: inline-block; margin: 0 12pt 0 0; }
  figure { margin: 4pt 0; }
  .scroll > svg, .head > svg { width: calc(var(--drawn) * .78px); height: auto;
                               max-width: 100%; max-height: 250mm; }
  th, td { padding: .1rem .35rem; } table { font-size: 8pt; }
  td.remark { min-width: 10em; } thead th { white-space: normal; vertical-align: bottom; }
  thead { display: table-header-group; }
}
)css";

}  // namespace drift::report
