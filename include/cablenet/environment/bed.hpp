#pragma once

/// The data of a seabed.  bed_contact.hpp computes the forces of contact with it.
namespace cablenet::environment {

/// A flat bed without edges.
struct Bed {
  double level = 0;                  ///< z [m]
  double stiffness = 0;              ///< pressure per indentation [Pa/m], > 0
  double damping = 0;                ///< pressure per rate of indentation [Pa s/m], >= 0
  double friction = 0;               ///< Coulomb's coefficient, >= 0
  double friction_velocity = 0.01;   ///< v_s, the speed at which friction is 1/sqrt(2) of Coulomb's [m/s], > 0
};

}   // namespace cablenet::environment
