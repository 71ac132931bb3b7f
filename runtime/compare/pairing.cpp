// See pairing.h.
#include "runtime/compare/pairing.h"

namespace twincraft {

void Pairing::add(std::size_t engine, Observation sample) {
  ++added_.at(engine);
  if (over_) return;
  waiting_.at(engine).push_back(std::move(sample));
  deliver();
}

void Pairing::end(std::size_t engine) {
  if (!waiting_.at(engine).empty()) return;
  over_ = true;
  for (std::deque<Observation>& queue : waiting_) queue.clear();
}

void Pairing::deliver() {
  auto& [a, b] = waiting_;
  while (!a.empty() && !b.empty()) {
    if (a.front().time != b.front().time) {
      over_ = true;
      a.clear();
      b.clear();
      return;
    }
    ++pairs_;
    take_(a.front(), b.front());
    a.pop_front();
    b.pop_front();
  }
}

}  // namespace twincraft
