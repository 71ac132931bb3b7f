// See bare_numbers.h. Tested by tests/compiler/bare_numbers_test.cpp.
#include "compiler/schema/bare_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

/// One entry of a list, read again for its unit.
struct Entry {
  const Node* node;
  Quantity quantity;

  bool is_bare() const { return quantity.unit.empty() && quantity.value != 0.0; }
  bool is_scaled() const { return !quantity.unit.empty() && quantity.factor != 1.0; }
};

std::vector<Entry> entries_of(const std::vector<const Node*>& nodes, SiUnit si) {
  std::vector<Entry> entries;
  for (const Node* node : nodes)
    if (node->is_scalar()) entries.push_back({node, parse_quantity(node->scalar, si)});
  std::erase_if(entries, [](const Entry& entry) { return !entry.quantity.error.empty(); });
  return entries;
}

/// A number of which one asks whether it was meant so.
bool is_unusual(double value, const Usual& usual) {
  const double size = std::abs(value);
  if (usual.largest == 0.0) return false;
  return size > usual.largest || (size >= usual.largest_whole && size == std::floor(size));
}

/// "45 rad is 7.16 turns", "6000 rad/s is 57295.8 rpm"
std::string consequence_of(double value, SiUnit si) {
  const double turns = value / (2.0 * std::numbers::pi);
  if (si == "rad") return fmt::format("{} rad is {:.3g} turns", shortest(value), turns);
  return fmt::format("{} rad/s is {:.6g} rpm", shortest(value), 60.0 * turns);
}

/// @return whether there was something to warn of
bool warn_of_mixture(const std::vector<Entry>& entries, SiUnit si, const ReadContext& context) {
  const auto bare = std::ranges::find_if(entries, &Entry::is_bare);
  const auto scaled = std::ranges::find_if(entries, &Entry::is_scaled);
  if (bare == entries.end() || scaled == entries.end()) return false;
  context.diagnostics
      .warning(Code::kMixedUnits, bare->node->span,
               fmt::format("{} mixes {} with the plain number {}, which is {} {}", context.where,
                           describe(*scaled->node), describe(*bare->node), bare->node->scalar, si))
      .with_hint(fmt::format("write `{} {}` if that is meant, else `{} {}`", bare->node->scalar,
                             scaled->quantity.unit, bare->node->scalar, si));
  return true;
}

}  // namespace

Usual usual_of(SiUnit si) {
  // Beyond a whole turn; beyond half a turn if it is a round number, as degrees mostly are.
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (si == "rad") return {kTurn, 4.0, "deg"};
  if (si == "rad/s") return {kTurn, 4.0, "deg/s"};
  return {};
}

void judge_bare_numbers(const std::vector<const Node*>& nodes, SiUnit si, const Usual& usual,
                        const ReadContext& context) {
  if (nodes.size() < 2 && usual.largest == 0.0) return;
  const std::vector<Entry> entries = entries_of(nodes, si);
  if (warn_of_mixture(entries, si, context)) return;
  for (const Entry& entry : entries) {
    if (!entry.is_bare() || !is_unusual(entry.quantity.value, usual)) continue;
    warn_of_bare_number(*entry.node, consequence_of(entry.quantity.value, si), usual.meant, si,
                        context);
    return;  // one is enough for a list
  }
}

bool is_bare_number(const Node& node) {
  return node.is_scalar() && parse_number(node.scalar).error.empty();
}

void warn_of_bare_number(const Node& node, const std::string& consequence, std::string_view meant,
                         SiUnit si, const ReadContext& context) {
  context.diagnostics
      .warning(
          Code::kBareNumber, node.span,
          fmt::format("{} has the plain number {}: {}", context.where, describe(node), consequence))
      .with_hint(fmt::format("write `{} {}` if that is meant, else `{} {}`", node.scalar, meant,
                             node.scalar, si));
}

std::vector<const Node*> scalars_of(const Node& node) {
  if (node.is_scalar()) return {&node};
  std::vector<const Node*> scalars;
  if (!node.is_list()) return scalars;
  for (const Node& item : node.items)
    for (const Node* scalar : scalars_of(item)) scalars.push_back(scalar);
  return scalars;
}

}  // namespace twincraft
