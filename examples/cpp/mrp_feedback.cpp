// Attitude feedback on three reaction wheels, through the C++ interface.
//
//   mrp_feedback models/quickstart.yaml
//
// A proportional-derivative law in modified Rodrigues parameters slows the rotation of the hub and
// turns it back towards its initial attitude. It acts ten times a second for half a minute. Every
// tick prints the time and the state, exactly, as hexadecimal numbers; examples/c and
// examples/python hold the same law and print the same bytes. Compile with -ffp-contract=off to
// get them on processors with fused multiply-add.
#include <twincraft/simulation.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using Vector = std::array<double, 3>;

struct Wheel {
  std::string torque;  // input
  Vector axis;         // as in the spec
};
const std::array<Wheel, 3> kWheels = {
    {{"rw_x.torque", {1, 0, 0}}, {"rw_y.torque", {0, 1, 0}}, {"rw_z.torque", {0, 0, 1}}}};

constexpr double kK = 3.0;   // [N m]
constexpr double kP = 12.0;  // [N m s]

/// All digits, as Python's float.hex() and, but for zero, C's "%.13a" print them.
void print_exactly(double x) {
  if (x == 0.0)
    std::fputs(std::signbit(x) ? "-0x0.0p+0" : "0x0.0p+0", stdout);
  else
    std::printf("%.13a", x);
}

void print_line(const twincraft::Simulation& simulation, double time) {
  print_exactly(time);
  for (const double x : simulation.state()) {
    std::putchar(' ');
    print_exactly(x);
  }
  std::putchar('\n');
}

/// What is asked of the wheels; the hub gets the opposite. @return [N m], hub axes
Vector torque_for(const double* q_BN, const double* omega_BN_B) {
  Vector torque_B{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double sigma_BN = q_BN[1 + i] / (1.0 + q_BN[0]);
    torque_B[i] = kK * sigma_BN + kP * omega_BN_B[i];
  }
  return torque_B;
}

void fly(const char* spec) {
  const twincraft::Model model = twincraft::Model::load(spec);
  const std::size_t attitude = model.find(TC_OUTPUTS, "q_BN").first;
  const std::size_t rate = model.find(TC_OUTPUTS, "omega_BN_B").first;
  twincraft::Simulation simulation(model);

  const auto control = [&](double time) {
    print_line(simulation, time);
    const std::vector<double> y = simulation.observe();
    const Vector torque_B = torque_for(&y[attitude], &y[rate]);
    for (const auto& [torque, axis] : kWheels)
      simulation.drive(torque,
                       axis[0] * torque_B[0] + axis[1] * torque_B[1] + axis[2] * torque_B[2]);
  };
  print_line(simulation, simulation.run_until(30.0, 0.1, control));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: mrp_feedback SPEC\n", stderr);
    return 1;
  }
  try {
    fly(argv[1]);
  } catch (const twincraft::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
