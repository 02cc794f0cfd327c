#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace postprocess
{
  /** One picture for gnuplot; the script names the data files and sets neither terminal nor output. */
  struct GnuplotJob
  {
    std::string                        script;
    std::map<std::string, std::string> data;                  ///< name of the file -> its text
    int                                width = 0, height = 0; ///< [pixel]
  };

  /**
   * Let gnuplot, in a child process, draw a PNG file; the destination is replaced only by a complete picture.
   * @throws OutputError when gnuplot is not installed or does not understand, the file cannot be written, or drawing is to stop.
   */
  void draw_with_gnuplot(const std::filesystem::path &destination, const GnuplotJob &job);

  /** From now on a picture is given up as soon as this says so: it is called every few milliseconds while gnuplot draws. */
  void stop_drawing_if(std::function<bool()> requested);

  /** A text as gnuplot reads it back literally: between single quotes. */
  std::string gnuplot_quoted(const std::string &text);
} // namespace postprocess
