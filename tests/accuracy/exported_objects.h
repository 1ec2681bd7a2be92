#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "modules/geometry/solid.h"

namespace declutter::accuracy {

// The frames of an exported folder's objects.jsonl by name; without label images. Throws
// std::runtime_error with file and line on what is not such a line, or on a frame given twice.
std::map<std::string, ObjectList> ReadExportedObjects(const std::filesystem::path& output_dir);

}  // namespace declutter::accuracy
