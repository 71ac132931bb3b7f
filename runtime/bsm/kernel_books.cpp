// The books of kernel.h, compiled like kernel.cpp but apart from it: what is inlined here must not
// keep anything from being inlined into a step. Tested by tests/runtime/books_test.cpp.
#include "runtime/bsm/bookkeeper.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {
namespace {

/// From pages to books: all at once.
template <class H, class S>
class Reader {
 public:
  using Pages = BookPages<H>;
  using T = typename Pages::T;

  Reader(const Vehicle<H, S>& vehicle, Pages& pages)
      : vehicle_(vehicle), causes_(vehicle.book_causes()), pages_(pages) {}

  void read() {
    const Four<T> mass = all(&Page::mass);
    const Four<T> motion = all(&Page::motion);
    power_ = own_power_ = motion.value;
    if (causes_.fall) force_N_ = mass.value * all(&Page::fall);
    if (causes_.drive || causes_.pull) read_changes(mass, motion.vector);
    put();
  }

 private:
  using Page = BookPage<H>;

  void read_changes(const Four<T>& mass, const Vec<T>& momentum) {
    omega_ = all(&Page::omega);
    dcm_NB_ = all(&Page::dcm_NB);
    if (causes_.drive) read_driving();
    if (causes_.pull) read_pulls();
    const T minus_inverse = T(-1.0) / mass.value;
    move_to_center(minus_inverse * mass.vector,
                   plus_cross(minus_inverse * momentum, omega_, minus_inverse * mass.vector));
  }

  /// Loads and mass that leaves. The power on the whole vehicle is that about B, were it at rest,
  /// and what B itself does.
  void read_driving() {
    leaving_ = all(&Page::leaving);
    const Four<T> driving = all(&Page::driving);
    const Four<T> turning = all(&Page::turning);
    const Vec<T> v_BN_N = all(&Page::v_BN_N);
    const Vec<T> held_torque = spread<T>(vehicle_.held_on_hub().torque);
    force_ = driving.vector + spread<T>(vehicle_.held_on_hub().force);
    torque_ = turning.vector + held_torque;
    power_B_ = driving.value + dot(omega_, held_torque);
    if (causes_.flow) add_leaving_hub();
    const Vec<T> from_B = dcm_NB_ * force_;
    const Vec<T> force_N = from_B + leaving_.value * v_BN_N;
    force_N_ += force_N;
    power_ += turning.value + power_B_ + T(0.5) * dot(from_B + force_N, v_BN_N);
  }
  void add_leaving_hub() {
    const LinkMass<H>& rate = vehicle_.hub_mass_rate();
    const Vec<T> moment = spread<T>(rate.moment), spin = spread<T>(rate.J) * omega_;
    leaving_.value += T(rate.mass);
    leaving_.vector += moment;
    force_ = plus_cross(force_, omega_, moment);
    torque_ += spin;
    power_B_ += T(0.5) * dot(spin, omega_);
  }

  /// What is pulled otherwise than B: the potential covers its forces.
  void read_pulls() {
    const Four<T> pulls = all(&Page::pulls);
    const Four<T> twists = all(&Page::twists);
    force_N_ += dcm_NB_ * pulls.vector;
    power_ += twists.value;
    force_ += pulls.vector;
    torque_ += twists.vector;
    power_B_ += pulls.value + dot(omega_, twists.vector);
  }

  /// About the centre of mass C, which moves by -v_BC. What C itself does drops out: neither sum of
  /// m (r - r_C) nor of m (v - v_C) is anything.
  void move_to_center(const Vec<T>& r_BC, const Vec<T>& v_BC) {
    own_power_ += power_B_ + dot(v_BC, force_ + (T(0.5) * leaving_.value) * v_BC);
    torque_ = plus_cross(torque_, leaving_.vector, v_BC);
    torque_PntC_N_ = dcm_NB_ * plus_cross(torque_, r_BC, force_ + leaving_.value * v_BC);
  }

  void put() {
    const Vec<T>&f = force_N_, &n = torque_PntC_N_;
    if constexpr (Pages::kPages == 1) {
      for (std::size_t l = 0; l < kLanes<T>; ++l) {
        pages_.rates(0)[l] = {lane(power_, l),
                              {lane(f.x, l), lane(f.y, l), lane(f.z, l)},
                              {lane(n.x, l), lane(n.y, l), lane(n.z, l)},
                              lane(own_power_, l)};
      }
    } else {
      // As wide as the stepper reads them: it would wait for narrower ones.
      std::array<double*, Pages::kPages> first, second;
      for (std::size_t l = 0; l < first.size(); ++l) {
        first[l] = &pages_.rates(l)->power;
        second[l] = pages_.rates(l)->torque_PntC_N.data();
      }
      put_lanes({power_, f.x, f.y, f.z}, first);
      put_lanes({n.x, n.y, n.z, own_power_}, second);
    }
  }

  // Of all pages.
  template <class Pick>
  Vec<T> all(const Pick& vector) const {
    return {pages_.each([&](const Page& p) -> const H& { return vector(p).x; }),
            pages_.each([&](const Page& p) -> const H& { return vector(p).y; }),
            pages_.each([&](const Page& p) -> const H& { return vector(p).z; })};
  }
  Vec<T> all(Vec<H> Page::*member) const {
    return all([=](const Page& p) -> const Vec<H>& { return p.*member; });
  }
  Four<T> all(Four<H> Page::*member) const {
    return {pages_.each([=](const Page& p) -> const H& { return (p.*member).value; }),
            all([=](const Page& p) -> const Vec<H>& { return (p.*member).vector; })};
  }
  Mat<T> all(Mat<H> Page::*member) const {
    return {all([=](const Page& p) -> const Vec<H>& { return (p.*member).x; }),
            all([=](const Page& p) -> const Vec<H>& { return (p.*member).y; }),
            all([=](const Page& p) -> const Vec<H>& { return (p.*member).z; })};
  }

  const Vehicle<H, S>& vehicle_;
  const BookCauses& causes_;
  Pages& pages_;
  Vec<T> omega_;
  Mat<T> dcm_NB_;
  // Summed up, about B.
  Four<T> leaving_;
  Vec<T> force_, torque_;
  T power_B_{};
  // BookRates.
  T power_{}, own_power_{};
  Vec<T> force_N_, torque_PntC_N_;
};

}  // namespace

// Flattened, or sums would pass through memory and be read, wider than they were written, while
// they are on their way there.
template <class H, class S>
[[gnu::flatten, gnu::noinline]] void settle_books(const Vehicle<H, S>& vehicle,
                                                  BookPages<H>& pages) {
  if (!pages.wait()) return;
  pages.fill();
  Reader<H, S>(vehicle, pages).read();
  pages.clear();
}

template <class H, class S>
[[gnu::flatten]] void write_books(Vehicle<H, S>& vehicle, const Number<H>* state,
                                  BookPages<H>& pages, BookRates* rates) {
  Bookkeeper<H, S> keeper(vehicle, state);
  if (!vehicle.book_causes().are_inner()) {
    keeper.write(pages.next(rates));
    if (pages.are_full()) settle_books(vehicle, pages);
    return;
  }
  const H power = keeper.inner_power();
  for (std::size_t l = 0; l < kLanes<H>; ++l) {
    rates[l] = {};
    rates[l].power = rates[l].own_power = lane(power, l);
  }
}

template void write_books(Vehicle<double, Pair>&, const double*, BookPages<double>&, BookRates*);
template void write_books(Vehicle<Batch, Batch>&, const double*, BookPages<Batch>&, BookRates*);
template void settle_books(const Vehicle<double, Pair>&, BookPages<double>&);
template void settle_books(const Vehicle<Batch, Batch>&, BookPages<Batch>&);

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
