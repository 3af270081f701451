#pragma once
#include <petscsys.h>

#include <stdexcept>
#include <utility>

/// The one seam to PETSc: error codes become exceptions, objects are owned.
namespace cablenet::petsc {

/// PETSC_SUCCESS and PETSC_UNLIMITED, which PETSc has from 3.19 and 3.22 on.
inline constexpr auto success = static_cast<PetscErrorCode>(0);
#if PETSC_VERSION_LT(3, 22, 0)
inline constexpr int unlimited = -1;
#else
inline constexpr int unlimited = PETSC_UNLIMITED;
#endif

/// A PETSc call failed: a bug or a resource that ran out; main does not catch it.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(int code, const char* file, int line);

/// @throws Failure with PETSc's text and the caller's file:line if code is an error.
/// The built-ins are those of std::source_location, which clang 14 does not have.
inline void check(int code, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (code != 0) fail(code, file, line);
}

/// Move-only owner of one PETSc object.
template <class T, auto Destroy>
class Handle {
public:
  Handle() = default;
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_ != nullptr) Destroy(&object_);
  }
  operator T() const { return object_; }
  /// For PETSc's create functions.
  T* out() { return &object_; }

private:
  T object_ = nullptr;
};

}   // namespace cablenet::petsc
