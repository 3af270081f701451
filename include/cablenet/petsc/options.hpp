#pragma once
#include <petscsys.h>

#include <string>
#include <vector>

/// Questions to PETSc's options database, where the command line stands.  A prefix is that of a solver within another:
/// with "relax_" the option -ksp_type is looked up as -relax_ksp_type.
/// Tests: tests/cases/options.py
namespace cablenet::petsc {

/// Not collective.
bool has_option(const char* name, const char* prefix = nullptr);

/// The names of all options that the user gave, without the dash.  Not collective.
std::vector<std::string> given_options();

/// Options that the user gave and nothing has asked for yet, as "-name value".  Not collective.
std::vector<std::string> unused_options();

/// An option of the program's own, as PETSc's -help shows it.
struct OptionText {
  const char* name;   ///< with the dash
  const char* help;   ///< one line
};

/// Each asks for an option's value and shows the option where the user asked for -help.  Collective.
/// @param fallback  the value where the option is not given
double number_option(MPI_Comm communicator, const char* prefix, const OptionText& option, double fallback);
std::string text_option(MPI_Comm communicator, const char* prefix, const OptionText& option,
                        const std::string& fallback);
bool flag_option(MPI_Comm communicator, const char* prefix, const OptionText& option);

/// Whether an option may ask PETSc to show or test something while it solves.  An option that setting up the solvers
/// did not ask for may.  Not collective.  @pre the solvers are set up
bool shows_while_solving();

/// While it exists and `off` is true, PETSc's solvers do not look up what to show (-snes_view and the like).  A small
/// step spends a sixth of its time on these look-ups.  Not collective.
class ViewersOff {
public:
  explicit ViewersOff(bool off);
  ~ViewersOff();
  ViewersOff(const ViewersOff&) = delete;
  ViewersOff& operator=(const ViewersOff&) = delete;

private:
  bool off_;
};

}   // namespace cablenet::petsc
