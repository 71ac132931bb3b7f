// See synonyms.h. Tested by tests/compiler/synonyms_test.cpp.
#include "compiler/schema/synonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/schema/table_info.h"

namespace twincraft {
namespace {

struct KeySynonym {
  std::string_view sections;
  std::string_view written;
  std::string_view meant;
};

struct WordSynonym {
  std::string_view written;
  std::string_view meant;
};

constexpr KeySynonym kKeys[] = {
#define TWINCRAFT_KEY(sections, written, meant) KeySynonym{sections, written, meant},
#define TWINCRAFT_WORD(written, meant)
#include "compiler/schema/synonyms.def"
#undef TWINCRAFT_KEY
#undef TWINCRAFT_WORD
};

constexpr WordSynonym kWords[] = {
#define TWINCRAFT_KEY(sections, written, meant)
#define TWINCRAFT_WORD(written, meant) WordSynonym{written, meant},
#include "compiler/schema/synonyms.def"
#undef TWINCRAFT_KEY
#undef TWINCRAFT_WORD
};

/// `item` is one of those between the separators of `list`.
bool is_listed(std::string_view item, std::string_view list, char separator) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(separator), list.size());
    if (list.substr(0, end) == item) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

/// As it is compared: `Time-Step` is `time_step`.
std::string normal(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == ' ') c = '_';
  }
  if (!result.starts_with('-')) std::ranges::replace(result, '-', '_');
  return result;
}

bool has_key(const TableInfo& info, std::string_view key) {
  return std::ranges::any_of(info.fields,
                             [key](const FieldInfo& field) { return field.key == key; });
}

std::string did_you_mean(std::string_view word) { return fmt::format("did you mean `{}`?", word); }

/// The synonym of `written` in this section; null: none.
const KeySynonym* find_key(const TableInfo& info, std::string_view written) {
  const auto found = std::ranges::find_if(kKeys, [&](const KeySynonym& entry) {
    return is_listed(info.name, entry.sections, '|') && is_listed(written, entry.written, ' ');
  });
  return found == std::end(kKeys) ? nullptr : &*found;
}

/// `mass_kg`, `angle_deg`: our key and its unit.
std::string hint_for_suffix(const TableInfo& info, const std::string& key) {
  const std::size_t end = key.rfind('_');
  if (end == std::string::npos) return {};
  for (std::size_t at = end; at != std::string::npos && at > 0; at = key.rfind('_', at - 1)) {
    const std::string name = key.substr(0, at);
    const std::string unit = key.substr(at + 1);
    if (!has_key(info, name) || !is_listed(unit,
                                           "kg g t m mm cm km deg rad rpm s ms min h n mn nm "
                                           "kg_m2 m_s km_s rad_s deg_s si",
                                           ' '))
      continue;
    return fmt::format("did you mean `{}`? a unit stands with the value, such as `12 deg`", name);
  }
  return {};
}

/// Words that name an integrator of variable step: two orders, or Fehlberg's letter.
bool looks_adaptive(const std::string& word) {
  const auto digits = std::ranges::count_if(word, [](char c) { return c >= '0' && c <= '9'; });
  return digits >= 2 || word.find('f') != std::string::npos;
}

/// Those of `words` that may be meant: never a fixed step where an adaptive one is.
std::vector<std::string> candidates(const std::string& word, std::vector<std::string> words) {
  if (std::ranges::find(words, "rkf45") == words.end()) return words;
  const bool adaptive = looks_adaptive(word);
  std::erase_if(
      words, [adaptive](const std::string& each) { return each.starts_with("rkf") != adaptive; });
  return words;
}

/// `321` is `zyx`.
std::string axis_letters(const std::string& word) {
  std::string letters = word;
  for (char& c : letters)
    if (c >= '1' && c <= '3') c = static_cast<char>('x' + (c - '1'));
  return letters;
}

}  // namespace

std::string hint_for_key(const TableInfo& info, std::string_view key) {
  const KeySynonym* synonym = find_key(info, key);
  if (synonym == nullptr) synonym = find_key(info, normal(key));
  if (synonym == nullptr) return hint_for_suffix(info, normal(key));
  return has_key(info, synonym->meant) ? did_you_mean(synonym->meant) : std::string(synonym->meant);
}

std::string hint_for_word(std::string_view word, const std::vector<std::string>& words) {
  const std::string wanted = normal(word);
  const auto offered = [&words](std::string_view each) {
    return std::ranges::find(words, each) != words.end();
  };
  for (const WordSynonym& synonym : kWords) {
    if (!is_listed(wanted, synonym.written, ' ')) continue;
    const std::size_t colon = synonym.meant.find(':');
    const std::string_view choice = synonym.meant.substr(0, colon);
    if (!offered(choice)) continue;
    return colon == std::string_view::npos ? did_you_mean(choice)
                                           : std::string(synonym.meant.substr(colon + 1));
  }
  if (const std::string letters = axis_letters(wanted); letters != word && offered(letters))
    return did_you_mean(letters);
  const std::string near = nearest(word, candidates(wanted, words));
  return near.empty() ? std::string() : did_you_mean(near);
}

}  // namespace twincraft
