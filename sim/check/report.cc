#include "sim/check/report.h"

#include "sim/files/base64.h"
#include "sim/files/markup.h"

namespace dodgesim {

namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>dodgesim check-sensor</title>
<style>
body { font: 14px/1.4 sans-serif; max-width: 1320px; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 0.6em 0; }
th, td { border-bottom: 1px solid #ddd; padding: 2px 14px 2px 0; text-align: left; }
td { font-family: monospace; }
.FAIL { color: #b00; font-weight: bold; }
.off { color: #888; }
img { border: 1px solid #ddd; margin: 4px; max-width: 640px; }
p { max-width: 60em; }
</style>
</head>
<body>
)";

std::string table(const Check& check) {
  std::string html =
      "<table>\n<tr><th>check</th><th>measured</th><th>expected</th><th></th></tr>\n";
  for (const CheckLine& line : check.lines) {
    const std::string outcome = outcome_text(line.outcome);
    html += "<tr class=\"" + outcome + "\"><td>" + markup_escaped(line.name) + "</td><td>" +
            markup_escaped(line.measured) + "</td><td>" + markup_escaped(line.expected) +
            "</td><td>" + outcome + "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string picture(const Plot& plot) {
  return "<img alt=\"" + markup_escaped(plot.title) + "\" src=\"data:image/png;base64," +
         base64(png_of(plot)) + "\">\n";
}

}  // namespace

std::string html_report(const std::string& subject, const std::vector<Check>& checks) {
  std::string html = kHead;
  html += "<h1>Self-tests of the event camera</h1>\n<p>" + markup_escaped(subject) + "</p>\n";
  for (const Check& check : checks) {
    html += "<h2>" + markup_escaped(check.title) + "</h2>\n<p>" + markup_escaped(check.method) +
            "</p>\n";
    html += table(check);
    for (const Plot& plot : check.plots) html += picture(plot);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace dodgesim
