#pragma once
#include <string>

#include "cablenet/scene/scene.hpp"

/// Reads scene files.  src/scene/README.md lists their keys.  Tests: tests/unit/read_test.cpp, tests/cases/broken/
namespace cablenet::scene {

/// The scene that `text` describes.  All that the file alone can tell to be wrong is refused.
/// @param text  the YAML text   @param file  its name, for messages only
/// @throws InputError with one line that names the file and line, the key, the value, what is allowed and what to do.
Scene read_scene(const std::string& text, const std::string& file);

}   // namespace cablenet::scene
