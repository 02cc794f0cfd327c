#include "postprocess/vtk/pvd.h"

#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/numeric_text.h"

#include <cstdio>

namespace postprocess
{
  namespace
  {
    std::string file_name(const std::string &name, const std::size_t number, const std::string &extension)
    {
      char digits[32]; // fits the longest number of 64 bits
      std::snprintf(digits, sizeof(digits), "_%06zu", number);
      return name + digits + extension;
    }
  } // namespace

  PvdCollection::PvdCollection(const std::filesystem::path &output_folder,
                               const std::string           &name_,
                               const std::string           &extension_)
    : folder(output_folder)
    , name(name_)
    , extension(extension_)
  {
    std::error_code error;
    std::filesystem::create_directories(folder / name, error);
    if (error)
      throw OutputError((folder / name).string() + ": the folder cannot be made: " + error.message() + ".");
  }

  std::filesystem::path PvdCollection::next() const { return folder / name / file_name(name, times.size(), extension); }

  void PvdCollection::add(const double time)
  {
    times.push_back(time);
    write_list();
  }

  void PvdCollection::restore(const base::Column &listed_before)
  {
    times = listed_before;
    if (!times.empty())
      write_list();
  }

  void PvdCollection::write_list() const
  {
    std::vector<PvdPart> parts;
    for (std::size_t i = 0; i < times.size(); ++i)
      parts.push_back({times[i], 0, "", name + "/" + file_name(name, i, extension)});
    write_pvd(folder / (name + ".pvd"), parts);
  }

  std::string piece_name(const std::string &stem, const std::size_t rank, const std::string &extension)
  {
    return stem + "." + std::to_string(rank) + extension;
  }

  void write_pvd(const std::filesystem::path &path, const std::vector<PvdPart> &parts)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const PvdPart &p : parts)
      {
        text += "    <DataSet timestep=\"";
        numeric_text::append(text, p.time);
        text += "\" part=\"" + std::to_string(p.part) + "\"";
        if (!p.name.empty())
          text += " name=\"" + p.name + "\"";
        text += " file=\"" + p.file + "\"/>\n";
      }
    write_text(path, text + "  </Collection>\n</VTKFile>\n");
  }
} // namespace postprocess
