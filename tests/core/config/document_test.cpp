#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/config/override.hpp"

namespace drift::config::document_test {
namespace {

class Document : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The message load_text() refuses the file with.
  static std::string refusal(const std::string& path) {
    try {
      load_text(path);
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), ExitCode::config);
      EXPECT_TRUE(std::string(error.what()).starts_with(path + ":")) << error.what();
      return error.what();
    }
    return "read without complaint";
  }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("driftscope_document_" + std::to_string(::getpid()));
};

TEST_F(Document, WhatIsNoRegularFileIsRefusedWithoutBlocking) {
  EXPECT_NE(refusal(path("absent.toml")).find("No such file"), std::string::npos);
  std::filesystem::create_directory(path("folder.toml"));
  EXPECT_NE(refusal(path("folder.toml")).find("is a directory"), std::string::npos);
  ASSERT_EQ(::mkfifo(path("pipe.toml").c_str(), 0600), 0);
  EXPECT_NE(refusal(path("pipe.toml")).find("pipe"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("device"), std::string::npos);
}

TEST_F(Document, AHugeFileIsRefusedBySize) {
  std::ofstream(path("huge.toml")).put('a');
  std::filesystem::resize_file(path("huge.toml"), std::uintmax_t{1} << 30);  // sparse
  EXPECT_NE(refusal(path("huge.toml")).find("1073741824 bytes"), std::string::npos);
}

TEST_F(Document, AByteOrderMarkOfUtf8IsSkippedAndThatOfUtf16Named) {
  std::ofstream(path("bom.toml")) << "\xef\xbb\xbf"
                                  << "a = 1\n";
  EXPECT_EQ(load_text(path("bom.toml")), "a = 1\n");
  std::ofstream(path("wide.toml")) << "\xff\xfe" << 'a';
  EXPECT_NE(refusal(path("wide.toml")).find("UTF-16"), std::string::npos);
  std::ofstream(path("nul.toml")) << "a = 1\nb" << '\0' << "c\n";
  EXPECT_NE(refusal(path("nul.toml")).find(":2:2: a NUL byte"), std::string::npos);
}

std::string syntax_error(const std::string& text) {
  try {
    parse_document(text, "t.toml");
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::config);
    return error.what();
  }
  return "parsed without complaint";
}

TEST(Toml, SyntaxErrorsCarryLineAndColumn) {
  EXPECT_TRUE(syntax_error("a = 1\nb = \n").starts_with("t.toml:2:"));
  EXPECT_TRUE(syntax_error("a = 1\na = 2\n").starts_with("t.toml:2:5:"));  // a key given twice
  EXPECT_TRUE(syntax_error("[a]\n[a]\n").starts_with("t.toml:2:"));
  EXPECT_TRUE(syntax_error("a = \"\xff\"\n").starts_with("t.toml:1:"));
  EXPECT_TRUE(syntax_error("a = 9223372036854775808\n").starts_with("t.toml:1:"));
}

TEST(Toml, OpenBracketsDoNotAbort) {  // toml++ asserts on "[ {" unless told otherwise
  EXPECT_TRUE(syntax_error("[ {").starts_with("t.toml:1:"));
  EXPECT_TRUE(syntax_error("a = [ {").starts_with("t.toml:1:"));
  EXPECT_TRUE(syntax_error("[[").starts_with("t.toml:1:"));
}

TEST(Toml, DeepNestingIsRefusedWhateverItsForm) {
  std::string dotted = "a", header = "[a";
  for (int i = 0; i < 100000; ++i) dotted += ".a", header += ".a";
  EXPECT_TRUE(syntax_error(dotted + " = 1\n").starts_with("t.toml:1:"));
  EXPECT_TRUE(syntax_error(header + "]\n").starts_with("t.toml:1:"));
  EXPECT_TRUE(syntax_error("a = " + std::string(100000, '[')).starts_with("t.toml:1:"));
  std::string tables = "a = ";
  for (int i = 0; i < 40; ++i) tables += "{ a = ";
  EXPECT_TRUE(syntax_error(tables + "1" + std::string(40, '}')).starts_with("t.toml:1:"));
  EXPECT_NO_THROW(parse_document(
      "# " + std::string(1000, '.') + "\na = \"" + std::string(1000, '.') + "\"\n", "t"));
}

TEST(Toml, WhatIsWrittenReadsBackToTheSameTree) {
  const std::string text =
      "b = 1\na = 1e3\ntitle = \"a \\\"quoted\\\" \\\\ line\\u0007\"\nday = 1979-05-27\n"
      "list = [ 1.0, 2.5, \"x\" ]\nempty = []\n[s]\nk = { normal = [ \"1 deg\", \"2 deg\" ] }\n"
      "[s.t]\n\"a b.c\" = true\n[s.t.u]\nv = 1\n[[f]]\nname = \"one\"\n[f.p]\nx = -1\n[[f]]\nname "
      "= \"two\"\n";
  const Node first = parse_document(text, "t");
  const std::string written = to_document(first);
  EXPECT_EQ(to_document(parse_document(written, "t")), written);
  const Node second = parse_document(written, "t");
  EXPECT_EQ(second.find("title")->text, first.find("title")->text);
  EXPECT_EQ(second.find("a")->kind, Node::Kind::real);
  EXPECT_EQ(second.find("s")->find("t")->find("u")->find("v")->integer, 1);
  EXPECT_TRUE(second.find("s")->find("t")->find("a b.c")->boolean);
  EXPECT_EQ(second.find("f")->items.at(0).find("p")->find("x")->integer, -1);
  EXPECT_EQ(second.find("f")->items.at(1).find("name")->text, "two");
}

TEST(Override, ReplacesAddsAndAddressesByNumberAndName) {
  Node root = parse_document(
      "[[filter]]\nname = \"one\"\n[[filter]]\nname = \"b.2\"\n[plan]\ndwell = \"1 h\"\n", "t");
  apply_override(root, "plan.dwell", "10 min");
  apply_override(root, "filter.0.coupling", "eq6");
  apply_override(root, "filter.one.starts", "3");
  apply_override(root, "filter.\"b.2\".coupling", "\"eq5\"");
  apply_override(root, "truth.parameters.eta_x", "{ normal = [\"1 deg\", \"2 deg\"] }");
  apply_override(root, "readout.gimbals", "false");
  EXPECT_EQ(root.find("plan")->find("dwell")->text, "10 min");
  EXPECT_EQ(root.find("plan")->find("dwell")->at.set_key, "plan.dwell");
  EXPECT_EQ(root.find("filter")->items[0].find("coupling")->text, "eq6");
  EXPECT_EQ(root.find("filter")->items[0].find("starts")->integer, 3);
  EXPECT_EQ(root.find("filter")->items[1].find("coupling")->text, "eq5");
  EXPECT_EQ(root.find("truth")->find("parameters")->find("eta_x")->find("normal")->items[1].text,
            "2 deg");
  EXPECT_TRUE(root.find("readout")->find("gimbals")->is(Node::Kind::boolean));
}

TEST(Override, ATermIsAddressedByItsKey) {
  Node root = parse_document(
      "[[term]]\nkey = \"mine\"\n[[term]]\nkey = \"1st\"\nparameters = { P = { value = 37 } }\n",
      "t");
  apply_override(root, "term.1st.parameters.P.value", "40");
  apply_override(root, "term.0.equation", "A");
  EXPECT_EQ(root.find("term")->items[1].find("parameters")->find("P")->find("value")->integer, 40);
  EXPECT_EQ(root.find("term")->items[0].find("equation")->text, "A");
  try {
    apply_override(root, "term.mien.equation", "B");
    ADD_FAILURE() << "there is none of that key";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no element named 'mien'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("'mine'"), std::string::npos) << error.what();
  }
}

TEST(Override, AWayThatLeadsNowhereIsRefusedByItsKey) {
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"filter.two.coupling", "eq5"},
           {"filter.1.coupling", "eq5"},
           {"filter.-1.x", "1"},
           {"title.x", "1"},
           {"", "1"},
           {".a", "1"},
           {"a.", "1"},
           {"a..b", "1"},
           {"\"a", "1"},
           {"a", "[1, 2"},
           {"a", "{ b = }"},
           {"a", "\"open"},
           {"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q", "1"}}) {
    Node root = parse_document("title = \"t\"\n[[filter]]\nname = \"one\"\n", "t");
    try {
      apply_override(root, key, value);
      ADD_FAILURE() << key << "=" << value << " was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), ExitCode::config);
      EXPECT_TRUE(std::string(error.what()).starts_with("--set " + key + ":")) << error.what();
    }
  }
}

TEST(Override, AValueCannotSmuggleInASecondKey) {
  Node root = parse_document("a = 1\n", "t");
  apply_override(root, "a", "2\nb = 3");
  EXPECT_EQ(root.find("b"), nullptr);
  EXPECT_EQ(root.find("a")->text, "2\nb = 3");  // a string, which no reader of a number accepts
}

}  // namespace
}  // namespace drift::config::document_test
