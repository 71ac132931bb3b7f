// The laws of all forces that follow the motion of links, in any scalar: one line for each. A law
// says on how many links it acts, takes its constants and inputs lane by lane, and adds what it
// does at one state; see stream.h for the form.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "runtime/forces/stream.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// Laws of one kind, and the data of which they are made.
template <class Law, class Data, std::vector<Data> Forces::*kData>
struct ForceKind {
  std::vector<Law> laws;
  static const std::vector<Data>& data_of(const Forces& forces) { return forces.*kData; }
};

template <class S>
using ForceKinds = std::tuple<ForceKind<StreamLaw<S>, Stream, &Forces::streams>>;

/// All of them that a vehicle has.
template <KernelScalar S>
class ForceList {
 public:
  /// @param lanes  one per lane, alike: they act on the same links
  explicit ForceList(std::span<const Forces* const> lanes = {}) {
    if (lanes.empty()) return;
    first_ = lanes[0];
    for_each_kind([&lanes](auto& kind) {
      kind.laws.resize(kind.data_of(*lanes[0]).size());
      for (std::size_t l = 0; l < lanes.size(); ++l)
        for (std::size_t i = 0; i < kind.laws.size(); ++i)
          kind.laws.data()[i].set(l, kind.data_of(*lanes[l]).data()[i]);
    });
  }

  /// @param inputs  Inputs, or what says the same in the numbers of S
  void hold(std::size_t l, const Forces& forces, const auto& inputs) {
    if (l == 0) acts_ = false;
    for_each_kind([&](auto& kind) {
      for (std::size_t i = 0; i < kind.laws.size(); ++i)
        acts_ = kind.laws.data()[i].hold(l, kind.data_of(forces).data()[i], inputs) || acts_;
    });
  }

  /// One of them may do something until the next hold().
  bool acts() const { return acts_; }

  /// @param motion_of  gives the LinkMotion of a link
  /// @param push       takes a link and the Pull on it, about its origin
  template <class MotionOf, class Push>
  void add(const Surroundings<S>& around, const MotionOf& motion_of, const Push& push) const {
    for_each_kind([&](const auto& kind) {
      for (std::size_t i = 0; i < kind.laws.size(); ++i)
        add_one(kind.laws.data()[i], kind.data_of(*first_).data()[i].links(), around, motion_of,
                push);
    });
  }

 private:
  template <class Each>
  void for_each_kind(const Each& each) {
    std::apply([&each](auto&... kind) { (each(kind), ...); }, kinds_);
  }
  template <class Each>
  void for_each_kind(const Each& each) const {
    std::apply([&each](const auto&... kind) { (each(kind), ...); }, kinds_);
  }
  template <class Law, class Links, class MotionOf, class Push>
  static void add_one(const Law& law, const Links& links, const Surroundings<S>& around,
                      const MotionOf& motion_of, const Push& push) {
    std::array<LinkMotion<S>, Law::kLinks> motions;
    std::array<Pull<S>, Law::kLinks> pulls{};
    for (std::size_t k = 0; k < Law::kLinks; ++k) motions[k] = motion_of(links[k]);
    law.add(around, motions, pulls);
    for (std::size_t k = 0; k < Law::kLinks; ++k) push(links[k], pulls[k]);
  }

  ForceKinds<S> kinds_;
  const Forces* first_ = nullptr;  // of lane 0, which says where all act
  bool acts_ = false;
};

}  // namespace twincraft::TWINCRAFT_KERNEL
