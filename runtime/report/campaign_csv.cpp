#include "runtime/report/campaign_csv.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/report/csv.h"

namespace twincraft {
namespace {

std::string heading(const std::string& name, const std::string& unit) {
  return ',' + text_cell(fmt::format("{} [{}]", name, unit));
}

}  // namespace

std::string text_cell(std::string_view text) {
  std::string cell;
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos)
    cell = '\'';
  for (const char c : text) {
    if (c == '"') cell += c;  // twice
    cell += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return cell.find_first_of(",\"") == std::string::npos ? cell : '"' + cell + '"';
}

std::string CampaignCsv::header() const {
  std::string text = "member";
  for (const DrawnNumber& one : table_.header().drawn) text += heading(one.name, one.unit);
  for (const OutputColumn& one : table_.header().outputs) text += heading(one.name, one.unit);
  return text + ",verdict,reason,seconds\n";
}

void CampaignCsv::append(std::size_t row, std::string& text) const {
  text += std::to_string(table_.members()[row]);
  for (std::size_t i = 0; i < table_.header().drawn.size(); ++i) {
    text += ',';
    append_number(table_.drawn(i)[row], text);
  }
  for (std::size_t i = 0; i < table_.header().outputs.size(); ++i) {
    text += ',';
    if (const double value = table_.output(i)[row]; !std::isnan(value)) append_number(value, text);
  }
  text += fmt::format(",{},{},", verdict_name(table_.verdict(row)), text_cell(table_.reason(row)));
  append_number(table_.seconds()[row], text);
  text += '\n';
}

}  // namespace twincraft
