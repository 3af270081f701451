#pragma once
#include <string>

#include "cablenet/scene/scene.hpp"

/// The scene file's reader: YAML text -> Scene.  Tests: tests/unit/read_test.cpp, tests/cases/broken/
namespace cablenet::scene {

/// The scene that `text` describes, validated as far as a file alone can be.
/// @param text  the YAML text   @param file  its name, for messages only
/// @throws InputError naming file:line, key, value, what is allowed and what to do.
Scene read_scene(const std::string& text, const std::string& file);

}   // namespace cablenet::scene
