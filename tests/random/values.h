// Values of the language as their authors might write them: quantities with and without units,
// vectors in either spelling, attitudes in any form, schedules.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/random/draw.h"

namespace twincraft::random_vehicles {

using Json = nlohmann::ordered_json;

/// `value` in SI, written plainly or in some unit of `dimension` ("kg", "m", "rad", "rad/s", ...).
Json quantity(Draw& draw, double value, const std::string& dimension);
/// Three quantities, or `{value, unit}`.
Json vector(Draw& draw, const Vector3d& value, const std::string& dimension);
/// Three plain numbers of any length.
Json direction(Draw& draw, const Vector3d& value);
Json rows(const Matrix3d& m);

/// The tensor [kg m2] of some body of this mass [kg] and radius [m]: three moments or a full one.
Json inertia(Draw& draw, double mass, double radius);

/// Quaternion, its conjugate, MRP, direction cosines, Euler angles or two aligned axes.
/// @param with_orbit  directions of the orbit may be named
Json attitude(Draw& draw, bool with_orbit);

/// A number about `size`, or steps of it during `duration` [s].
Json schedule(Draw& draw, double size, double duration, bool positive,
              const std::string& dimension);
/// Ordered half-open intervals.
Json intervals(Draw& draw, double duration);

}  // namespace twincraft::random_vehicles
