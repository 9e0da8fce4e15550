#include <gtest/gtest.h>

#include <thinwall/experiments/check/readers.hpp>

namespace thinwall {
namespace {

TEST(Xml, takes_what_every_reader_takes) {
  for (
      const char* good : {
          "<a/>",
          "<?xml version=\"1.0\"?>\n<!DOCTYPE svg>\n<!-- c -->\n<svg a='1' b = \"&lt;&#39;&#x1F;'\"><x:g-1 /></svg >\n",
          "<a>it's > \"b\" &amp; ]] ]&gt; \u00b5<![CDATA[<&]]></a>",
      }) {
    EXPECT_EQ(xml_fault(good), "") << good;
  }
}

TEST(Xml, names_the_line_and_what_is_wrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "there is no element"},
      {"<a>\n<b>\n</a>", "line 3: </a> ends nothing"},
      {"<a>", "<a> has no end"},
      {"<a/><b/>", "a second element"},
      {"<a/>text", "text outside of the one element"},
      {"<a>\n]]></a>", "line 2: ]]> in text"},
      {"<a>b & c</a>", "& without an entity"},
      {"<a>&nbsp;</a>", "& without an entity"},
      {"<a>&#x;</a>", "& without an entity"},
      {"<a>&lt</a>", "& without an entity"},
      {"<a b='1' b='2'/>", "b stands twice"},
      {"<a b='1'c='2'/>", "a blank is missing in <a>"},
      {"<a b=1/>", "\" is missing"},
      {"<a b='<'/>", "< in an attribute"},
      {"<a b/>", "= is missing"},
      {"<a><1/></a>", "a name is missing"},
      {"<a><!-- -- --></a>", "> is missing"},
      {"<a><![CDATA[</a>", "]]> is missing"},
      {"<a>\xef\xbf\xbe</a>", "no letter: \\xef"},
      {"<a>\x1b</a>", "no letter: \\x1b"},
      {"<a>\xff</a>", "no letter: \\xff"},
  };
  for (const auto& [text, fault] : cases) {
    EXPECT_NE(xml_fault(text).find(fault), std::string::npos) << text << "\n" << xml_fault(text);
  }
}

}  // namespace
}  // namespace thinwall
