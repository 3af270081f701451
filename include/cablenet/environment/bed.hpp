#pragma once

/// The seabed as data; what contact with it does is in bed_contact.hpp.
namespace cablenet::environment {

/// Flat and without end.
struct Bed {
  double level = 0;                  ///< z [m]
  double stiffness = 0;              ///< [Pa/m], > 0
  double damping = 0;                ///< [Pa s/m], >= 0
  double friction = 0;               ///< Coulomb's coefficient, >= 0
  double friction_velocity = 0.01;   ///< at which friction is 1/sqrt(2) of Coulomb's [m/s], > 0
};

}   // namespace cablenet::environment
