#include "apps/runs/sequential/law_origin.h"

#include "apps/runs/sequential/transfer_section.h"

#include <regex>

namespace apps
{
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

} // namespace apps
