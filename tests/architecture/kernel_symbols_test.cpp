// Nothing leaks out of the objects of a wider instruction set, the kernel's and the stepper's: the
// linker keeps one copy of an inline function of the same name, and that copy could be the one an
// older processor can not run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

struct KernelObjects {
  std::string set;
  std::string paths;                 // a colon between two
  std::vector<std::string> entries;  // among what they define
};

std::ostream& operator<<(std::ostream& out, const KernelObjects& objects) {
  return out << objects.set;
}

class KernelSymbols : public testing::TestWithParam<KernelObjects> {
 protected:
  void SetUp() override {
#ifndef NDEBUG
    GTEST_SKIP() << "without optimisation the library's own templates are not inlined";
#endif
  }

  /// What the objects define for others to see.
  std::vector<std::string> defined() const {
    std::vector<std::string> names;
    std::istringstream paths(GetParam().paths);
    for (std::string path; std::getline(paths, path, ':');) {
      const test::ProgramResult nm = test::run_program(
          TWINCRAFT_NM, {"-C", "--defined-only", "--extern-only", "--format=just-symbols", path});
      EXPECT_EQ(nm.exit_code, 0) << nm.err;
      std::istringstream lines(nm.out);
      for (std::string line; std::getline(lines, line);) names.push_back(line);
    }
    return names;
  }

  /// Its mangled name holds a name of the set, so no other object defines the same.
  bool is_own(const std::string& name) const {
    const std::string& set = GetParam().set;
    // nm leaves the name of a lambda within a generic lambda as it is.
    return name.starts_with("_ZN9twincraft3bsm" + std::to_string(set.size()) + set) ||
           name.find("twincraft::bsm::" + set + "::") != std::string::npos ||
           name.find("twincraft::" + set + "::") != std::string::npos ||
           name.find("xsimd_" + set + "::") != std::string::npos;
  }
};

/// Data, the same whoever defines it.
bool is_shared_data(const std::string& name) {
  return name == "typeinfo for twincraft::bsm::Kernel" ||
         name == "typeinfo name for twincraft::bsm::Kernel" ||
         name == "typeinfo for twincraft::bsm::Observer" ||
         name == "typeinfo name for twincraft::bsm::Observer" ||
         name == "DW.ref.__gxx_personality_v0";
}

TEST_P(KernelSymbols, AreRead) {
  for (const std::string& entry : GetParam().entries)
    EXPECT_THAT(defined(), Contains(HasSubstr(GetParam().set + "::" + entry)));
}

TEST_P(KernelSymbols, BelongToTheInstructionSet) {
  std::vector<std::string> leaked;
  for (const std::string& name : defined()) {
    if (!is_own(name) && !is_shared_data(name)) leaked.push_back(name);
  }
  EXPECT_THAT(leaked, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Of, KernelSymbols,
    testing::Values(
        KernelObjects{"avx2",
                      TWINCRAFT_AVX2_OBJECTS,
                      {"new_kernel(", "write_books<", "settle_books<", "new_observer("}},
        KernelObjects{"avx512",
                      TWINCRAFT_AVX512_OBJECTS,
                      {"new_kernel(", "write_books<", "settle_books<", "new_observer("}},
        KernelObjects{"sums_avx2", TWINCRAFT_SUMS_AVX2_OBJECTS, {"stage_sums("}}),
    [](const auto& each) { return each.param.set; });

}  // namespace
}  // namespace twincraft
