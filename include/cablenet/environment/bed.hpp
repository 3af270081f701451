#pragma once

/// The data of a seabed.  bed_contact.hpp computes the forces of contact with it.
namespace cablenet::environment {

/// A flat bed without edges.
struct Bed {
  double level = 0;                ///< z [m]
  double stiffness = 0;            ///< pressure per indentation [Pa/m], > 0
  double damping = 0;              ///< pressure per rate of indentation [Pa s/m], >= 0
  double friction = 0;             ///< Coulomb's coefficient mu, >= 0
  double friction_stiffness = 0;   ///< pressure per travel of what sticks [Pa/m], >= 0; 0: from what lies there
  double friction_velocity = 0;    ///< v_s of viscous friction [m/s], >= 0; 0: friction holds by springs

  /// What lies on the bed sticks to it up to Coulomb's force.
  bool sticks() const { return friction > 0 && friction_velocity == 0; }
};

}   // namespace cablenet::environment
