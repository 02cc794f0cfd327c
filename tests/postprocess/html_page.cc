#include "postprocess/files/html_page.h"

#include "tests/postprocess/scratch_folder.h"

#include <catch2/catch.hpp>

using Catch::Contains;

TEST_CASE("base64: texts are those of RFC 4648, and every byte is kept", "[postprocess]")
{
  using postprocess::base64;
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("a page is one file that asks nothing of another place, with what it is given as text", "[postprocess]")
{
  postprocess::HtmlPage page("A & <b>");
  page.list({});
  page.table({{"name", "value"}, {"a<b", "-1.5e+03"}, {"word", "3 to 4"}});
  page.folded("file", "set Kind = \"x\"");
  page.picture("gone.png", "nothing"); // costs no report
  const std::string text = page.text();
  CHECK_THAT(text, Contains("<title>A &amp; &lt;b&gt;</title>") &&
                     Contains("<td>a&lt;b</td><td class=\"n\">-1.5e+03</td>") && Contains("<td>3 to 4</td>") &&
                     Contains("set Kind = &quot;x&quot;"));
  CHECK_THAT(text, !Contains("<ul>") && !Contains("<img") && !Contains("http"));
}
