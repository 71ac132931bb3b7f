// See judgement.h.
#include "runtime/report/judgement.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/report/words.h"

namespace twincraft {
namespace {

using Of = JudgedFigure::Of;

std::string clause_of(const JudgedFigure& figure) {
  switch (figure.of) {
    case Of::kAgreement:
      return "the engines disagree";
    case Of::kConservation:
      return fmt::format("the {} of {} exceeds its tolerance", words_of(figure.key, {}).label,
                         engine_label(figure.engine));
    case Of::kReference:
      break;
  }
  return fmt::format("an engine is further from `{}` than allowed", figure.reference);
}

}  // namespace

std::string exceeded_words(std::span<const JudgedFigure> exceeded) {
  std::vector<std::string> clauses;
  for (const JudgedFigure& figure : exceeded) {
    std::string clause = clause_of(figure);
    if (std::ranges::find(clauses, clause) == clauses.end()) clauses.push_back(std::move(clause));
  }
  return fmt::format("{}", fmt::join(clauses, "; "));
}

std::string held_words(const Member& member) {
  return member.judges_agreement() ? "the engines agree" : "every tolerance held";
}

std::string held_words(const Report& report) {
  return report.summary()->judges_agreement() ? "the engines agree" : "every tolerance held";
}

}  // namespace twincraft
