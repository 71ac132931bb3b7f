// The instruction sets that the kernel is compiled for: which of them a processor has, and which it
// runs faster. That is not always the widest. The choice is a table of measurements, not a race at
// the start of a run: the same program on the same processor must give the same bytes every time.
// `tools/benchmark` holds the table against the machine it runs on.
// Tested by tests/runtime/processor_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft::bsm {

/// x86-64 as every processor has it; with AVX2 and FMA; with AVX-512 (F, DQ, VL). From narrow to
/// wide: a processor that has one has those before it.
enum class InstructionSet { kPortable, kAvx2, kAvx512 };

/// For people: `x86-64`, `AVX2`, `AVX-512`.
std::string_view name_of(InstructionSet set);
/// On a command line: `portable`, `avx2`, `avx512`.
std::string_view word_of(InstructionSet set);
/// Nothing if no set has this word.
std::optional<InstructionSet> instruction_set_of(std::string_view word);

/// What a kernel steps: one spacecraft, like limbs of it two by two; or one spacecraft per lane.
enum class Use { kOne, kBatch };

/// As CPUID describes it.
struct Processor {
  std::string vendor;  // "GenuineIntel", "AuthenticAMD"; empty if it does not say
  InstructionSet widest = InstructionSet::kPortable;
};

/// A set, and in words why it and no other.
struct Choice {
  InstructionSet set = InstructionSet::kPortable;
  std::string reason;
};

/// What `processor` runs faster.
Choice choose(const Processor& processor, Use use);

/// The one that runs this program.
const Processor& this_processor();
/// All that it has, from narrow to wide.
std::vector<InstructionSet> instruction_sets();
/// choose() for it.
Choice choose(Use use);
InstructionSet fastest_instruction_set(Use use);

}  // namespace twincraft::bsm
