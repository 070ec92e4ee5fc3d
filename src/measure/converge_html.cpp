#include <algorithm>
#include <cmath>

#include "log_plot.h"
#include "welkin/core/units.h"
#include "welkin/measure/converge.h"

namespace welkin::measure {
namespace {

constexpr int kColours = 10;  // .c0 ... of the style; a second turn through them is dashed

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --paper: #fbfbf9; --card: #fff; --ink: #1d2126; --soft: #5b636e; --rule: #e3e5e8; --front: #c6d2e2;
  --floor: #eef0f2;
  --c0: #c8441b; --c1: #d18a00; --c2: #7a8f00; --c3: #1f8a4c; --c4: #0a8f98; --c5: #1f6fd6; --c6: #7b4fd0; --c7: #c13a8b; --c8: #6b4a32;
  --c9: #59626c; }
@media (prefers-color-scheme: dark) { :root { --paper: #14171b; --card: #1b1f25; --ink: #e8eaed; --soft: #9aa3ae; --rule: #2d333b; --front:
  #46566a;
  --floor: #20252c; --c0: #ff7d55; --c1: #f5b73b; --c2: #b9cf3f; --c3: #56c98a; --c4: #4fcfd6; --c5: #6fb0ff; --c6: #b294ff; --c7: #f583c4;
  --c8: #c69c7c;
  --c9: #a8b1bb; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans",
  sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 28px 18px 60px; }
h1 { font-size: 27px; line-height: 1.2; margin: 0 0 6px; letter-spacing: -0.01em; } h2 { font-size: 19px; margin: 38px 0 8px; }
p { margin: 6px 0 12px; max-width: 76ch; } .soft { color: var(--soft); } small { color: var(--soft); }
.card { background: var(--card); border: 1px solid var(--rule); border-radius: 10px; padding: 14px; }
.scroll { overflow-x: auto; } .plot { display: block; width: 100%; min-width: 520px; height: auto; font-size: 13px; fill: var(--ink); }
.plot .grid { stroke: var(--rule); } .plot .title { font-weight: 600; } .plot .faint { fill: var(--soft); font-size: 12px; }
.plot .guide { stroke: var(--soft); stroke-dasharray: 2 5; } .plot .floor { fill: var(--floor); }
.plot .front { fill: none; stroke: var(--front); stroke-width: 9; stroke-linejoin: round; stroke-linecap: round; opacity: 0.8; }
.plot .line { fill: none; stroke: currentColor; stroke-width: 1.8; } .plot .dashed { stroke-dasharray: 6 4; }
.plot .dot { fill: currentColor; stroke: var(--card); stroke-width: 1.2; cursor: pointer; } .plot .dot:hover, .plot .dot:focus { r: 7;
  outline: none; }
.plot .ring { fill: none; stroke: var(--ink); stroke-width: 1.4; } .plot g.dim { opacity: 0.14; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 16px; margin: 10px 2px 0; padding: 0; list-style: none; font-size: 14px; }
.legend li { display: flex; align-items: center; gap: 7px; cursor: default; } .legend i { width: 18px; border-top: 3px solid currentColor; }
.legend i.dashed { border-top-style: dashed; } .legend span { color: var(--ink); }
.c0 { color: var(--c0); } .c1 { color: var(--c1); } .c2 { color: var(--c2); } .c3 { color: var(--c3); } .c4 { color: var(--c4); }
.c5 { color: var(--c5); } .c6 { color: var(--c6); } .c7 { color: var(--c7); } .c8 { color: var(--c8); } .c9 { color: var(--c9); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 16px; } figure { margin: 0; }
img { width: 100%; display: block; border-radius: 6px; image-rendering: pixelated; background: #000; } figcaption { font-size: 13px;
  margin-top: 5px; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums; } th, td { padding: 4px 10px; text-align: right;
  white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } thead th { border-bottom: 2px solid var(--rule); } tbody tr + tr { border-top: 1px
  solid var(--rule); }
th button { font: inherit; font-weight: 600; color: inherit; background: none; border: 0; padding: 0; cursor: pointer; } th button::after {
  content: "\2195";
  color: var(--soft); margin-left: 4px; font-weight: 400; } th[aria-sort=ascending] button::after { content: "\2191"; color: inherit; }
th[aria-sort=descending] button::after { content: "\2193"; color: inherit; } tr.best td:first-child::before { content: "\25CF\00a0"; color:
  var(--c5); }
#tip { position: fixed; display: none; pointer-events: none; max-width: 320px; background: var(--ink); color: var(--paper); padding: 6px
  10px; border-radius: 6px;
  font-size: 13px; white-space: pre-line; z-index: 9; }
)css";

// What is pointed at or touched says its name; a name in the legend dims the other lines; columns sort.
constexpr const char* kScript = R"js(
const tip = document.getElementById('tip');
for (const dot of document.querySelectorAll('.dot')) {
  dot.querySelector('title').remove();
  const show = e => {
    tip.textContent = dot.dataset.name;
    tip.style.display = 'block';
    const b = dot.getBoundingClientRect(), w = tip.offsetWidth, h = tip.offsetHeight;
    tip.style.left = Math.max(6, Math.min(b.left + b.width / 2 - w / 2, innerWidth - w - 6)) + 'px';
    tip.style.top = (b.top > h + 14 ? b.top - h - 8 : b.bottom + 8) + 'px';
  };
  const hide = () => tip.style.display = 'none';
  for (const on of ['pointerenter', 'focus', 'click']) dot.addEventListener(on, show);
  for (const off of ['pointerleave', 'blur']) dot.addEventListener(off, hide);
}
for (const card of document.querySelectorAll('.card')) {
  const lines = [...card.querySelectorAll('.plot g')];
  card.querySelectorAll('.legend li').forEach((item, i) => {
    item.addEventListener('pointerenter', () => lines.forEach((g, k) => g.classList.toggle('dim', k != i)));
    item.addEventListener('pointerleave', () => lines.forEach(g => g.classList.remove('dim')));
  });
}
for (const table of document.querySelectorAll('table.sortable')) {
  table.querySelectorAll('th').forEach((head, column) => head.querySelector('button').addEventListener('click', () => {
    const up = head.getAttribute('aria-sort') != 'ascending', body = table.tBodies[0];
    const value = row => { const v = row.cells[column].dataset.v; return v === undefined ? row.cells[column].textContent : +v; };
    const order = (a, b) => typeof a == 'number' ? a - b : a.localeCompare(b);
    table.querySelectorAll('th').forEach(h => h.removeAttribute('aria-sort'));
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    [...body.rows].sort((a, b) => (up ? 1 : -1) * order(value(a), value(b))).forEach(row => body.append(row));
  }));
}
)js";

std::string base64(const std::string& bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kLetters[word >> (18 - 6 * k) & 63];
  }
  return out;
}

bool isIn(const std::vector<std::string>& list, const std::string& name) { return std::find(list.begin(), list.end(), name) != list.end(); }

struct Series {
  std::string name;
  std::vector<const ConvergeRow*> rows;
  int colour = 0;
  bool dashed = false, steps = false;  // steps: the step is what changes
};

std::vector<Series> seriesOf(const std::vector<ConvergeRow>& rows) {
  std::vector<Series> out;
  for (const auto& row : rows) {
    for (const auto& name : row.setting.series) {
      auto found = std::find_if(out.begin(), out.end(), [&](const Series& s) { return s.name == name; });
      if (found == out.end()) {
        const int n = int(out.size());
        found = out.insert(out.end(), {name, {}, n % kColours, n / kColours % 2 == 1, false});
      }
      found->rows.push_back(&row);
    }
  }
  for (auto& s : out) s.steps = s.rows.size() > 1 && s.rows[0]->setting.quality.step != s.rows[1]->setting.quality.step;
  return out;
}

std::string pointText(const ConvergeRow& row) {
  return fmt::format("{}\n{:.2f} ms, RMSE {:.4f}/255", row.setting.name, row.time_ms.median, row.error.rmse_255);
}

// Card of a plot with its legend; `note` says something of a series or is empty.
template <class Note>
std::string card(const LogPlot& plot, const std::vector<Series>& series, const Note& note) {
  std::string out = "<div class=\"card\"><div class=\"scroll\">" + svg(plot) + "</div><ul class=\"legend\">";
  for (const auto& s : series)
    out += fmt::format("<li class=\"c{}\"><i{}></i><span>{}</span>{}</li>", s.colour, s.dashed ? " class=\"dashed\"" : "", htmlText(s.name),
                       note(s));
  return out + "</ul></div>\n";
}

std::string timePlot(const ConvergeReport& report, const std::vector<Series>& series) {
  const auto front = paretoFront(report.rows);
  LogPlot plot{"time of a frame, ms", "RMSE, 0-255", "Error against time of all settings", {}, {}, report.truth.tolerance_255, {}};
  for (const auto& s : series) {
    PlotLine line{s.colour, s.dashed, {}};
    for (const auto* row : s.rows)
      line.points.push_back({row->time_ms.median, row->error.rmse_255, pointText(*row), isIn(front, row->setting.name)});
    plot.lines.push_back(std::move(line));
  }
  for (const auto& name : front)
    for (const auto& row : report.rows)
      if (row.setting.name == name) plot.front.push_back({row.time_ms.median, row.error.rmse_255, "", false});
  return card(plot, series, [](const Series&) { return std::string(); });
}

std::string orderPlot(const ConvergeReport& report, std::vector<Series> series) {
  std::erase_if(series, [](const Series& s) { return !s.steps; });
  if (series.empty()) return "";
  const auto orders = observedOrders(report.rows, report.truth.tolerance_255);
  LogPlot plot{"step", "RMSE, 0-255", "Error against step", {}, {}, report.truth.tolerance_255, {1, 2}};
  for (const auto& s : series) {
    PlotLine line{s.colour, s.dashed, {}};
    for (const auto* row : s.rows) line.points.push_back({row->setting.quality.step, row->error.rmse_255, pointText(*row), false});
    plot.lines.push_back(std::move(line));
  }
  const auto note = [&](const Series& s) {
    for (const auto& o : orders)
      if (o.series == s.name) return fmt::format("<small>order {:.2f}</small>", o.order);
    return std::string();
  };
  return "<h2>Order of convergence</h2><p>Error against step; the slope of a line is the order at which its error goes away, by least "
         "squares over the "
         "points that stand clear of the truth's own tolerance.</p>" +
         card(plot, series, note);
}

std::string cheapest(const ConvergeReport& report) {
  std::string out =
      "<h2>The cheapest that keeps a tolerance</h2><div class=\"card scroll\"><table><thead><tr><th>RMSE of at most</th><th>ms</th>"
      "<th>reached</th><th style=\"text-align:left\">setting</th></tr></thead><tbody>";
  for (const double e : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    const ConvergeRow* best = nullptr;
    for (const auto& row : report.rows)
      if (row.error.rmse_255 <= e && (best == nullptr || row.time_ms.median < best->time_ms.median)) best = &row;
    out += best != nullptr ? fmt::format("<tr><td>{:g}</td><td>{:.2f}</td><td>{:.3f}</td><td style=\"text-align:left\">{}</td></tr>", e,
                                         best->time_ms.median, best->error.rmse_255, htmlText(best->setting.name))
                           : fmt::format("<tr><td>{:g}</td><td>-</td><td>-</td><td style=\"text-align:left\">none of these</td></tr>", e);
  }
  return out + "</tbody></table></div>\n";
}

std::string thesisTable(const BudgetStepTable& t) {
  std::string out = fmt::format("<div class=\"card scroll\" style=\"margin-bottom:12px\"><p><b>{}</b></p><table><thead><tr><th>budget</th>",
                                htmlText(t.title));
  for (const auto& step : t.steps) out += "<th>" + htmlText(step) + "</th>";
  out += "</tr></thead><tbody>";
  std::string residency;
  for (std::size_t b = 0; b < t.cells.size(); ++b) {
    out += "<tr><td>" + htmlText(t.budgets[b]) + "</td>";
    for (const auto& cell : t.cells[b])
      out += fmt::format("<td>{:.1f} ms / {:.2f}{}</td>", cell.time_ms, cell.rmse_255,
                         cell.truth_rmse_255 ? fmt::format(" <small>({:.2f})</small>", *cell.truth_rmse_255) : "");
    out += "</tr>";
    if (!t.cells[b].empty() && !t.cells[b].front().residency.empty())
      residency += fmt::format("<br>{}: {}", htmlText(t.budgets[b]), htmlText(t.cells[b].front().residency));
  }
  return out + "</tbody></table>" + (residency.empty() ? "" : "<small>Residency" + residency + "</small>") + "</div>\n";
}

std::string settingsTable(const ConvergeReport& report) {
  static constexpr const char* kHeads[] = {"setting", "ms",   "p25..p75", "march ms", "RMSE",  "relative HDR", "p99",        "max",
                                           "> 2",     "flip", "samples",  "bricks",   "bytes", "tree ms",      "of it light"};
  std::string out = "<h2>All settings</h2><div class=\"card scroll\"><table class=\"sortable\"><thead><tr>";
  for (const char* head : kHeads) out += fmt::format("<th><button>{}</button></th>", htmlText(head));
  out += "</tr></thead><tbody>";
  const auto front = paretoFront(report.rows);
  const auto cell = [](double value, const std::string& text) { return fmt::format("<td data-v=\"{:.9g}\">{}</td>", value, text); };
  for (const auto& row : report.rows) {
    const auto march = row.passes_ms.find("march");
    const double march_ms = march != row.passes_ms.end() ? march->second.median : 0;
    const auto& e = row.error;
    out += fmt::format("<tr{}><td>{}</td>", isIn(front, row.setting.name) ? " class=\"best\"" : "", htmlText(row.setting.name));
    out += cell(row.time_ms.median, fmt::format("{:.2f}", row.time_ms.median));
    out += cell(row.time_ms.p75 - row.time_ms.p25, fmt::format("{:.2f}..{:.2f}", row.time_ms.p25, row.time_ms.p75));
    out += cell(march_ms, fmt::format("{:.2f}", march_ms)) + cell(e.rmse_255, fmt::format("{:.4f}", e.rmse_255));
    out += cell(e.relativeRmse, fmt::format("{:.5f}", e.relativeRmse)) + cell(e.p99_255, fmt::format("{:.2f}", e.p99_255));
    out += cell(e.max_255, fmt::format("{:.1f}", e.max_255)) + cell(e.shareOver2, fmt::format("{:.2f} %", 100 * e.shareOver2));
    out += cell(e.flip, std::isfinite(e.flip) ? fmt::format("{:.5f}", e.flip) : "-") +
           cell(double(row.samples), fmt::format("{}", row.samples));
    out += cell(row.residency.bricks, fmt::format("{}", row.residency.bricks)) + cell(double(row.bytes), bytesText(row.bytes));
    out += cell(row.settle_ms, fmt::format("{:.0f}", row.settle_ms)) + cell(row.light_ms, fmt::format("{:.0f}", row.light_ms)) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string ConvergeReport::html() const {
  const auto series = seriesOf(rows);
  std::string out =
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"><title>Welkin: error against time</title><style>";
  out += kStyle;
  out += "</style></head><body><main>\n<h1>Error against time</h1>";
  out += fmt::format("<p class=\"soft\">{}, view {}, {}x{}{}, {} settings. {}{}. {} timed frames each; time: {}.<br>{}</p>",
                     htmlText(context.scene), htmlText(view), context.width, context.height,
                     poses > 1 ? fmt::format(", {} poses", poses) : "", rows.size(), htmlText(context.glRenderer),
                     context.software ? " (software)" : "", repetitions, htmlText(clock), htmlText(context.build));
  out += fmt::format(
      "<p>Truth ({}): {}; it stands within an RMSE of {:.4f} of what it stands for. Errors are of displayed colours, 0 to 255, before "
      "rounding to 8 bits.</p>",
      htmlText(truth.kind), htmlText(truth.description), truth.tolerance_255);
  for (const auto& note : notes) out += "<p class=\"soft\">" + htmlText(note) + "</p>";
  for (const auto& t : tables) out += (&t == tables.data() ? "<h2>The thesis' Table 6.1</h2>" : "") + thesisTable(t);
  out +=
      "<h2>Error against time</h2><p>Down and to the left is better. The band joins the settings that no other one beats in both; they are "
      "ringed.</p>";
  out += timePlot(*this, series) + cheapest(*this) + orderPlot(*this, series);
  if (!pictures.empty()) {
    out += "<h2>Where the error is</h2><div class=\"pictures\">";
    for (const auto& p : pictures)
      out += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption><b>{0}</b><br>{2}</figcaption></figure>\n",
                         htmlText(p.title), base64(p.png), htmlText(p.caption));
    out += "</div>";
  }
  out += settingsTable(*this) + "<div id=\"tip\"></div></main><script>";
  out += kScript;
  return out + "</script></body></html>\n";
}

}  // namespace welkin::measure
