// Claims about the choice of instructions: a table decides, on processors as they describe
// themselves, and nothing is chosen that a processor lacks.
#include "runtime/bsm/processor.h"

#include <gmock/gmock.h>

namespace twincraft::bsm {
namespace {

constexpr InstructionSet kAll[] = {InstructionSet::kPortable, InstructionSet::kAvx2,
                                   InstructionSet::kAvx512};
constexpr const char* kVendors[] = {"GenuineIntel", "AuthenticAMD", "CentaurHauls", ""};

TEST(InstructionChoice, TakesAvx2ForOneSpacecraftWhereAvx512IsSlower) {
  const Choice choice = choose({"GenuineIntel", InstructionSet::kAvx512}, Use::kOne);
  EXPECT_EQ(choice.set, InstructionSet::kAvx2);
  EXPECT_THAT(choice.reason, testing::HasSubstr("Intel"));
}

TEST(InstructionChoice, TakesAvx512ForOneSpacecraftWhereItIsFaster) {
  const Choice choice = choose({"AuthenticAMD", InstructionSet::kAvx512}, Use::kOne);
  EXPECT_EQ(choice.set, InstructionSet::kAvx512);
  EXPECT_THAT(choice.reason, testing::HasSubstr("AMD"));
}

TEST(InstructionChoice, DoesNotTrustAvx512OfAMakerWhoseProcessorsNobodyMeasured) {
  const Choice choice = choose({"CentaurHauls", InstructionSet::kAvx512}, Use::kOne);
  EXPECT_EQ(choice.set, InstructionSet::kAvx2);
  EXPECT_THAT(choice.reason, testing::HasSubstr("not measured"));
}

TEST(InstructionChoice, TakesTheWidestForABatch) {
  for (const char* vendor : kVendors)
    for (const InstructionSet widest : kAll)
      EXPECT_EQ(choose({vendor, widest}, Use::kBatch).set, widest) << vendor;
}

TEST(InstructionChoice, TakesNothingThatTheProcessorLacksAndSaysWhy) {
  for (const char* vendor : kVendors)
    for (const InstructionSet widest : kAll)
      for (const Use use : {Use::kOne, Use::kBatch}) {
        const Choice choice = choose({vendor, widest}, use);
        EXPECT_LE(choice.set, widest) << vendor;
        EXPECT_FALSE(choice.reason.empty()) << vendor;
      }
}

TEST(InstructionChoice, IsTheSameEveryTime) {
  for (const Use use : {Use::kOne, Use::kBatch}) {
    EXPECT_EQ(fastest_instruction_set(use), fastest_instruction_set(use));
    EXPECT_EQ(choose(use).set, choose(this_processor(), use).set);
  }
}

TEST(InstructionSets, AreFoundByTheirWords) {
  for (const InstructionSet set : kAll) EXPECT_EQ(instruction_set_of(word_of(set)), set);
  for (const char* word : {"", "auto", "AVX2", "avx"})
    EXPECT_FALSE(instruction_set_of(word)) << word;
}

TEST(InstructionSets, OfThisProcessorEndWithItsWidest) {
  EXPECT_EQ(instruction_sets().front(), InstructionSet::kPortable);
  EXPECT_EQ(instruction_sets().back(), this_processor().widest);
}

}  // namespace
}  // namespace twincraft::bsm
