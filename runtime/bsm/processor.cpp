// See processor.h.
#include "runtime/bsm/processor.h"

#include <cpuid.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace twincraft::bsm {
namespace {

struct Names {
  std::string_view name, word;
};

// In the order of InstructionSet.
constexpr std::array<Names, 3> kNames{{
    {"x86-64", "portable"},
    {"AVX2", "avx2"},
    {"AVX-512", "avx512"},
}};

const Names& names(InstructionSet set) { return kNames[static_cast<std::size_t>(set)]; }

/// What a maker's processors run fastest, of the sets that the kernel is compiled for.
struct Measured {
  std::string_view vendor;
  InstructionSet one;
  std::string_view why;
};

// Of one spacecraft, whole RK4 steps of tools/benchmark. A batch fills all its lanes, so the widest
// set was the fastest on both.
constexpr std::array<Measured, 2> kMeasured{{
    {"GenuineIntel", InstructionSet::kAvx2,
     "AVX-512 takes 1.07 to 1.34 times as long on Intel processors"},
    {"AuthenticAMD", InstructionSet::kAvx512,
     "AVX-512 is up to 7 % faster than AVX2 on AMD processors"},
}};

// On a processor that nobody measured AVX2 can lose little, and AVX-512 much.
constexpr Measured kUnknown{"", InstructionSet::kAvx2,
                            "AVX-512 was not measured on this maker's processors"};

std::string vendor() {
  unsigned highest = 0;
  std::array<unsigned, 3> text{};
  if (__get_cpuid(0, &highest, &text[0], &text[2], &text[1]) == 0) return {};
  std::string vendor(sizeof text, '\0');
  std::memcpy(vendor.data(), text.data(), sizeof text);
  return vendor;
}

InstructionSet widest() {
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 &&
                      __builtin_cpu_supports("avx512dq") != 0 &&
                      __builtin_cpu_supports("avx512vl") != 0;
  if (!avx2) return InstructionSet::kPortable;
  return avx512 ? InstructionSet::kAvx512 : InstructionSet::kAvx2;
}

}  // namespace

std::string_view name_of(InstructionSet set) { return names(set).name; }
std::string_view word_of(InstructionSet set) { return names(set).word; }

std::optional<InstructionSet> instruction_set_of(std::string_view word) {
  const auto found = std::ranges::find(kNames, word, &Names::word);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<InstructionSet>(found - kNames.begin());
}

Choice choose(const Processor& processor, Use use) {
  if (use == Use::kBatch)
    return {processor.widest, "the widest of this processor: a batch fills all lanes"};
  if (processor.widest < InstructionSet::kAvx512)
    return {processor.widest, "the widest of this processor"};
  const auto* known = std::ranges::find(kMeasured, processor.vendor, &Measured::vendor);
  const Measured& row = known == kMeasured.end() ? kUnknown : *known;
  return {row.one, std::string(row.why)};
}

const Processor& this_processor() {
  static const Processor processor{vendor(), widest()};
  return processor;
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(this_processor().widest); ++i)
    sets.push_back(static_cast<InstructionSet>(i));
  return sets;
}

Choice choose(Use use) { return choose(this_processor(), use); }

InstructionSet fastest_instruction_set(Use use) { return choose(use).set; }

}  // namespace twincraft::bsm
