#include "apps/scene/sequential/law_origin.h"

#include "apps/scene/section.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "fem/points/registry.h"
#include "postprocess/files/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace apps
{
  namespace
  {
    constexpr const char *of_no_matter_to_particles[] = {"Box size", "Density", "Seed", "Cell particles"};

    using Leaves = std::function<bool(const std::string &)>; // what is of no matter

    /** Numbers however they were written, in full. */
    std::string plain(const std::string &value)
    {
      std::string text;
      for (const std::string &part : comma_separated(value))
        {
          const auto number = number_in(part);
          text += (text.empty() ? "" : ",") + (number ? fmt::format("{}", *number) : part);
        }
      return text;
    }

    std::string content_of(const Entry &entry)
    {
      const auto    file = std::filesystem::path(entry.place.file).parent_path() / entry.value;
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        throw base::InputError(file.string() + ": cannot be read.");
      const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      return fmt::format("{:x}", postprocess::Digest().add(content).value());
    }

    std::string digits(const postprocess::Digest &digest) { return fmt::format("{:016x}", digest.value()); }

    void add(const Section &section, const Leaves &leaves_out, postprocess::Digest &digest)
    {
      if (!section.needed())
        return;
      digest.add(section.name() + "{");
      for (const auto &entry : section.entries())
        if (entry->needed() && !leaves_out(entry->name) && !entry->value.empty())
          {
            digest.add(entry->name + "=");
            digest.add(entry->type == "file" ? content_of(*entry) : plain(entry->value));
            digest.add(";");
          }
      for (const auto &inner : section.sections())
        add(*inner, leaves_out, digest);
      digest.add("}");
    }
  } // namespace

  std::string digest_of_particles(const Section &particles)
  {
    const auto leaves_out = [](const std::string &name) {
      return std::find(std::begin(of_no_matter_to_particles), std::end(of_no_matter_to_particles), name) !=
             std::end(of_no_matter_to_particles);
    };
    postprocess::Digest digest;
    for (const char *name : {"Specimen", "Material", "Materials", "Regions", "Physics"})
      if (const Section *section = particles.find_section(name))
        add(*section, leaves_out, digest);
    return digits(digest);
  }

  std::string digest_of_material(const Section &law, const fem::MaterialKind &kind)
  {
    postprocess::Digest digest;
    add(
      law, [&kind](const std::string &name) { return kind.is_numerical(name); }, digest);
    return digits(digest);
  }
} // namespace apps
