#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace postprocess
{
  /**
   * Write a summary as indented JSON, atomically (see AtomicFile); numbers keep every bit.
   *
   * JSON has no NaN and no infinity. Each such number is written as null, and the top-level list "not_a_number" names
   * its place and value, for example "/figures/young_modulus/value: nan": a missing figure is seen, and cannot be taken
   * for one that was never requested. The list is absent when every number is finite.
   *
   * @throws std::invalid_argument if the summary is not an object or already has "not_a_number"; OutputError.
   */
  void write_json(const std::filesystem::path &path, nlohmann::json summary);
} // namespace postprocess
