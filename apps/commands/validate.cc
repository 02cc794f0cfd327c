#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/validation/validation.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace apps
{
  namespace
  {
    struct ValidateOptions
    {
      std::vector<std::string> pages;
      std::string              only;
    };

    bool is_html(const std::string &page) { return std::filesystem::path(page).extension() == ".html"; }

    /** @throws base::InputError before anything is computed */
    void require_pages(const std::vector<std::string> &pages)
    {
      for (const std::string &page : pages)
        if (!is_html(page) && std::filesystem::path(page).extension() != ".md")
          throw base::InputError("-o " + page + ": a page's name ends in .md or .html.");
    }

    std::vector<base::Reference> chosen_references(const ValidateOptions &options)
    {
      std::vector<base::Reference> chosen;
      std::string                  subjects;
      for (const base::Reference &reference : every_reference())
        {
          subjects += "\n  " + reference.subject;
          if (reference.subject.find(options.only) != std::string::npos)
            chosen.push_back(reference);
        }
      if (chosen.empty())
        throw base::InputError("--only " + options.only + ": no reference is about that. There are:" + subjects);
      return chosen;
    }

    void tell_of(const ComparedReference &one)
    {
      fmt::print("{:<58} {:>4} values, worst {:>7.2g} of its limit, {:.2g} s\n", one.reference.subject, one.rows.size(),
                 one.worst(), one.seconds);
      for (const base::Comparison &row : one.rows)
        if (!row.holds())
          fmt::print("  beyond its limit: {}: {:.10g} for {:.10g}\n", row.quantity, row.found, row.reference);
    }

    int validate(const ValidateOptions &options)
    {
      require_pages(options.pages);
      const std::vector<base::Reference> references = chosen_references(options);
      catch_interrupts();
      std::vector<ComparedReference> all;
      std::size_t                    beyond = 0, rows = 0;
      for (const base::Reference &reference : references)
        {
          if (interrupted())
            return exit_interrupted;
          all.push_back(compared(reference));
          tell_of(all.back());
          beyond += all.back().beyond();
          rows += all.back().rows.size();
        }
      fmt::print("{} values, {} beyond their limits\n", rows, beyond);
      for (const std::string &page : options.pages)
        {
          postprocess::write_text(page, is_html(page) ? validation_html(all) : validation_markdown(all));
          fmt::print("written to {}\n", page);
        }
      return beyond > 0 ? exit_failure : exit_success;
    }
  } // namespace

  void add_validate(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<ValidateOptions>();
    CLI::App  &command = *program.add_subcommand(
       "validate", "Published values, closed forms and other programs' answers beside what this program finds");
    command.footer(
      "The tests compare the same table. Exit status: 0 if every value is within its limit, 1 if one is not.");
    command
      .add_option("-o,--output", options->pages,
                  "A page to write, as Markdown or HTML; repeatable; default: only words")
      ->type_name("FILE.md|FILE.html")
      ->allow_extra_args(false);
    command.add_option("--only", options->only, "References whose subject holds this word")->type_name("WORD");
    command.callback([options, &chosen] { chosen = [options] { return validate(*options); }; });
  }
} // namespace apps
