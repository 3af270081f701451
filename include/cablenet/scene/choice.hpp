#pragma once
#include <array>

/// The words that a scene file has for the values of an enumeration.  The reader, its messages, the schema and the
/// reports all take them from here.  Tests: tests/unit/keys_test.cpp
namespace cablenet::scene {

template <class E>
struct Choice {
  E value;
  const char* name;   ///< as it stands in the file
};

/// All words of the enumeration E.  Each enumeration that a file can name specialises this beside its definition.
template <class E>
inline constexpr std::array<Choice<E>, 0> choices{};

/// The word for `value`; empty if a file cannot name it.
template <class E>
constexpr const char* name_of(E value) {
  for (const Choice<E>& choice : choices<E>)
    if (choice.value == value) return choice.name;
  return "";
}

}   // namespace cablenet::scene
