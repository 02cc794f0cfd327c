#include "apps/drivers/sequential/law_origin.h"

#include "apps/drivers/sequential/transfer_section.h"
#include "apps/scene/value_text.h"
#include "base/errors.h"
#include "postprocess/files/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

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

    std::string digits(const postprocess::Digest &digest) { return fmt::format("{:016x}", digest.value()); }
  } // namespace

  std::string LawOrigin::text() const { return test + ", particles " + particles + ", " + material + " " + continuum; }

  std::optional<LawOrigin> LawOrigin::read(const std::string &text)
  {
    static const std::regex form("(tension|compression), particles ([0-9a-f]{16}), (.+) ([0-9a-f]{16})");
    std::smatch             parts;
    if (!std::regex_match(text, parts, form))
      return {};
    return LawOrigin{parts[1], parts[2], parts[3], parts[4]};
  }

  std::string doubt_about_law(const TransferSection &transfer, const LawOrigin &here)
  {
    static const std::string way_out =
      " Damage may be far off. Let the scene find its own law (Transfer/Mapping law/Law = "
      "identify), or take that of: breccia transfer --identify SCENE";
    if (transfer.identifies())
      return "";
    if (!transfer.has_own())
      return "the mapping law \"" + transfer.law + "\" belongs to the published particles and concrete, not to these." +
             way_out;
    const auto found_for = LawOrigin::read(transfer.identified_for);
    if (!found_for)
      return "nothing says for which particles and continuum the constants of the mapping law were found "
             "(Transfer/Mapping "
             "law/Identified for)." +
             way_out;
    if (here.particles.empty())
      return "the particles come from files: whether the mapping law was identified for such cannot be seen.";
    if (found_for->particles != here.particles)
      return "the mapping law was identified for other particles (their size, packing, links or physics differ)." +
             way_out;
    if (found_for->continuum != here.continuum)
      return "the mapping law was identified for another " + here.material + " (constants of the continuum differ)." +
             way_out;
    if (!here.test.empty() && found_for->test != here.test)
      return "the mapping law was identified in " + found_for->test + ", and these particles are under " + here.test +
             "." + way_out;
    return "";
  }

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
