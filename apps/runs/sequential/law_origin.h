#pragma once

#include "fem/points/registry.h"

#include <optional>
#include <string>

namespace apps
{
  /**
   * What a mapping law was identified from: the test, and digests of what the particles and the continuum are made of. What leaves a law
   * as it is does not count: the size of the specimen, the seed of its packing, densities, and the size of elements.
   */
  struct LawOrigin
  {
    std::string test;      ///< "compression" or "tension"
    std::string particles; ///< 16 hexadecimal digits
    std::string material;  ///< of the continuum, by its name in a scene
    std::string continuum; ///< of its constants: 16 hexadecimal digits

    /** "compression, particles 0123456789abcdef, damage-plastic concrete fedcba9876543210" */
    std::string text() const;
    /** Nothing if the text is no such. */
    static std::optional<LawOrigin> read(const std::string &text);
  };

  struct TransferSection;

  /**
   * Why the mapping law of a scene may be wrong for it, in a sentence with a way out; "" where it was identified for it.
   * @param here what the scene has; test "": of another kind than pulling and crushing, particles "": not known
   */
  std::string doubt_about_law(const TransferSection &transfer, const LawOrigin &here);
} // namespace apps
