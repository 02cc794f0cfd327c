#include "postprocess/files/html_page.h"

#include "postprocess/files/page_contents.h"
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

TEST_CASE("a page is one file that loads nothing from another place, with what it is given as text", "[postprocess]")
{
  postprocess::HtmlPage page("A & <b>");
  page.list({});
  page.table({{"name", "value"}, {"a<b", "-1.5e+03"}, {"word", "3 to 4"}, {"unit", "-"}});
  page.folded("file", "set Kind = \"x\"");
  page.picture("gone.png", "nothing"); // costs no report
  const std::string text = page.text();
  CHECK_THAT(text, Contains("<title>A &amp; &lt;b&gt;</title>") &&
                     Contains("<td>a&lt;b</td><td class=\"n\">-1.5e+03</td>") && Contains("<td>3 to 4</td>") &&
                     Contains("<td>-</td>") && Contains("set Kind = &quot;x&quot;"));
  CHECK_THAT(text, !Contains("<ul>") && !Contains("<img") && !Contains("http"));
}

TEST_CASE("base64: bytes come back, and what is no such text is none", "[postprocess]")
{
  std::string bytes;
  for (int length = 0; length < 300; ++length)
    {
      CHECK(postprocess::bytes_of_base64(postprocess::base64(bytes)) == bytes);
      bytes += static_cast<char>(length * 37);
    }
  for (const char *wrong : {"Zg", "Zg=", "Z===", "Zm9v*mFy", "=m9v"})
    CHECK_FALSE(postprocess::bytes_of_base64(wrong));
}

TEST_CASE("a page gives back its scene and the files it holds, and notices damage", "[postprocess]")
{
  const postprocess_tests::ScratchFolder folder;
  const std::string scene = "set A = <b> & \"c\" # &lt;\n  set B = 1\n", content("\0\xff<&\"\n", 6);
  std::ofstream(folder / "in.bin", std::ios::binary) << content;
  postprocess::HtmlPage page("title");
  page.scene(scene);
  page.attach("Specimen/File", "/some/\"where\"/in.bin", folder / "in.bin");
  const auto read = postprocess::read_page_contents(page.text(), "page");
  CHECK(read.scene == scene);
  REQUIRE(read.files.size() == 1);
  CHECK(read.files[0].entry == "Specimen/File");
  CHECK(read.files[0].named == "/some/\"where\"/in.bin");
  CHECK(read.files[0].content == content);

  std::string damaged               = page.text();
  damaged[damaged.find("AP88") + 1] = 'B';
  CHECK_THROWS_WITH(postprocess::read_page_contents(damaged, "page"), Contains("Specimen/File") && Contains("damaged"));
  CHECK_THROWS_WITH(postprocess::read_page_contents("<html>", "page"), Contains("page: there is no scene"));
}

TEST_CASE("a page stays short enough to be sent: what is too long is named", "[postprocess]")
{
  const postprocess_tests::ScratchFolder folder;
  std::ofstream(folder / "long.bin", std::ios::binary) << std::string(900'000, 'x');
  postprocess::HtmlPage page("title");
  page.attach("Mesh/File", "long.bin", folder / "long.bin");
  page.picture(folder / "long.bin", "first"); // fits, as the file did not
  page.picture(folder / "long.bin", "second");
  CHECK(page.text().size() < postprocess::HtmlPage::largest + 100'000);
  CHECK_FALSE(postprocess::read_page_contents("<pre id=\"scene\"></pre>" + page.text(), "page").files.at(0).content);
  CHECK_THAT(page.text(), Contains("long.bin, 900000 bytes, too long for this page.") &&
                            Contains("long.bin (second) would make the page too long."));
}
