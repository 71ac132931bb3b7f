// AnyKind, and the kinds that combine other kinds. Tested by tests/compiler/kind_test.cpp.

#include "compiler/schema/own_kind.h"

namespace twincraft {

AnyKind::AnyKind(std::shared_ptr<const KindBody> body) : body_(std::move(body)) {}
AnyKind::AnyKind(const AnyKind&) = default;
AnyKind::AnyKind(AnyKind&&) noexcept = default;
AnyKind& AnyKind::operator=(const AnyKind&) = default;
AnyKind& AnyKind::operator=(AnyKind&&) noexcept = default;
AnyKind::~AnyKind() = default;

const std::string& AnyKind::text() const { return body_->text; }
const Json& AnyKind::schema() const { return body_->schema; }
const std::vector<const TableInfo*>& AnyKind::tables() const { return body_->tables; }
const Numbers& AnyKind::numbers() const { return body_->numbers; }

bool AnyKind::read_into(void* value, const Node& node, ReadContext& context) const {
  return body_->read(value, node, context);
}

bool AnyKind::reread_into(void* value, const Node& node, const Node& before,
                          ReadContext& context) const {
  return body_->reread(value, node, before, context);
}

Json AnyKind::write_from(const void* value) const { return body_->write(value); }

namespace {

using Words = std::vector<std::pair<std::string, std::int64_t>>;

std::vector<std::string> spellings_of(const Words& words) {
  std::vector<std::string> spellings;
  for (const auto& [word, meaning] : words) spellings.push_back(word);
  return spellings;
}

class WordsKind : public KindBody {
 public:
  WordsKind(Words words, WordAccess access)
      : KindBody(words_text(spellings_of(words), "or"), {{"enum", spellings_of(words)}}, {}, {}),
        words_(std::move(words)),
        spellings_(spellings_of(words_)),
        access_(access) {}

  bool read(void* value, const Node& node, ReadContext& context) const override {
    const std::optional<std::size_t> index = read_word(node, context, spellings_);
    if (index) access_.store(value, words_[*index].second);
    return index.has_value();
  }

  Json write(const void* value) const override {
    const std::int64_t written = access_.load(value);
    for (const auto& [word, meaning] : words_)
      if (meaning == written) return word;
    return nullptr;
  }

 private:
  Words words_;
  std::vector<std::string> spellings_;
  WordAccess access_;
};

class ListKind : public KindBody {
 public:
  ListKind(const AnyKind& item, std::size_t minimum, std::size_t maximum, ListAccess access)
      : KindBody("list of " + item.text(), list_schema(item.schema(), minimum, maximum),
                 item.tables(), {}),
        item_(item),
        minimum_(minimum),
        maximum_(maximum),
        access_(access) {}

  bool read(void* list, const Node& node, ReadContext& context) const override {
    if (!check_list(node, context, minimum_, maximum_, "a list")) return false;
    access_.clear(list);
    bool good = true;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      ReadContext at_item = item_of(context, i);
      good = item_.read_into(access_.append(list), node.items[i], at_item) && good;
    }
    return good;
  }

  bool reread(void* list, const Node& node, const Node& before,
              ReadContext& context) const override {
    // A list of another length need not have the same items at the same index.
    if (!node.is_list() || !before.is_list() || node.items.size() != before.items.size())
      return read(list, node, context);
    bool good = true;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      if (node.items[i] == before.items[i]) continue;
      ReadContext at_item = item_of(context, i);
      good =
          item_.reread_into(access_.edit(list, i), node.items[i], before.items[i], at_item) && good;
    }
    return good;
  }

  Json write(const void* list) const override {
    Json items = Json::array();
    for (std::size_t i = 0; i < access_.size(list); ++i)
      items.push_back(item_.write_from(access_.item(list, i)));
    return items;
  }

 private:
  AnyKind item_;
  std::size_t minimum_, maximum_;
  ListAccess access_;
};

class OneOrListKind : public KindBody {
 public:
  OneOrListKind(const AnyKind& item, const AnyKind& list, ListAccess access)
      : KindBody(item.text() + ", or a list of them", any_of(item.schema(), list.schema()),
                 item.tables(), item.numbers()),
        item_(item),
        list_(list),
        access_(access) {}

  bool read(void* list, const Node& node, ReadContext& context) const override {
    if (node.is_list()) return list_.read_into(list, node, context);
    access_.clear(list);
    return item_.read_into(access_.append(list), node, context);
  }

  Json write(const void* list) const override {
    return access_.size(list) == 1 ? item_.write_from(access_.item(list, 0))
                                   : list_.write_from(list);
  }

 private:
  AnyKind item_, list_;
  ListAccess access_;
};

class MaybeKind : public KindBody {
 public:
  MaybeKind(const AnyKind& kind, OptionalAccess access)
      : KindBody(kind.text(), kind.schema(), kind.tables(), kind.numbers()),
        kind_(kind),
        access_(access) {}

  bool read(void* optional, const Node& node, ReadContext& context) const override {
    if (kind_.read_into(access_.emplace(optional), node, context)) return true;
    access_.reset(optional);
    return false;
  }

  bool reread(void* optional, const Node& node, const Node& before,
              ReadContext& context) const override {
    void* const value = access_.edit(optional);
    if (value == nullptr) return read(optional, node, context);
    return kind_.reread_into(value, node, before, context);
  }

  Json write(const void* optional) const override {
    const void* value = access_.get(optional);
    return value != nullptr ? kind_.write_from(value) : Json(nullptr);
  }

 private:
  AnyKind kind_;
  OptionalAccess access_;
};

class EitherKind : public KindBody {
 public:
  EitherKind(bool (*suits)(const Node&), const AnyKind& first, const AnyKind& second,
             VariantAccess access)
      : KindBody(first.text() + ", or " + second.text(), any_of(first.schema(), second.schema()),
                 joined(first.tables(), second.tables()),
                 first.numbers().form != Numbers::Form::kNone ? first.numbers() : second.numbers()),
        suits_(suits),
        first_(first),
        second_(second),
        access_(access) {}

  bool read(void* variant, const Node& node, ReadContext& context) const override {
    if (suits_(node)) return first_.read_into(access_.emplace_first(variant), node, context);
    return second_.read_into(access_.emplace_second(variant), node, context);
  }

  Json write(const void* variant) const override {
    const void* first = access_.first(variant);
    return first != nullptr ? first_.write_from(first)
                            : second_.write_from(access_.second(variant));
  }

 private:
  bool (*suits_)(const Node&);
  AnyKind first_, second_;
  VariantAccess access_;
};

}  // namespace

AnyKind words_kind(Words words, WordAccess access) {
  return AnyKind(std::make_shared<WordsKind>(std::move(words), access));
}

AnyKind list_kind(const AnyKind& item, std::size_t minimum, std::size_t maximum,
                  ListAccess access) {
  return AnyKind(std::make_shared<ListKind>(item, minimum, maximum, access));
}

AnyKind one_or_list_kind(const AnyKind& item, ListAccess access) {
  return AnyKind(
      std::make_shared<OneOrListKind>(item, list_kind(item, 1, kAnyCount, access), access));
}

AnyKind maybe_kind(const AnyKind& kind, OptionalAccess access) {
  return AnyKind(std::make_shared<MaybeKind>(kind, access));
}

AnyKind either_kind(bool (*suits)(const Node&), const AnyKind& first, const AnyKind& second,
                    VariantAccess access) {
  return AnyKind(std::make_shared<EitherKind>(suits, first, second, access));
}

}  // namespace twincraft
