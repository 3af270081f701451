#pragma once
#include <string>

/// What the rows of the scene keys say, for editors and for people.  Tests: tests/unit/keys_test.cpp,
/// tests/cases/schema.py
namespace cablenet::scene {

/// A JSON Schema (draft 7) of the scene file.  It says all that a rule about one key can say; rules between keys are
/// the reader's alone.
std::string json_schema();

/// The reference of all keys, in Markdown: a table for each section.
std::string key_reference();

}   // namespace cablenet::scene
