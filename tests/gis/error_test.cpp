#include "gis/error.hpp"

#include <cpl_error.h>
#include <gtest/gtest.h>

#include "gis/crs/ogr_support.hpp"
#include "gis/secrets.hpp"

namespace coastmesh {
namespace {

TEST(OneLine, FoldsWhiteSpace) {
  EXPECT_EQ(oneLine("  cannot read\r\n\tthe file\x01: \n\n"), "cannot read the file :");
  EXPECT_EQ(oneLine("'süß.gpkg': ok"), "'süß.gpkg': ok");
  EXPECT_EQ(oneLine(" \n"), "");
}

TEST(OneLine, CutsAtAWord) {
  EXPECT_EQ(oneLine("one two three", 13), "one two three");
  EXPECT_EQ(oneLine("one two three", 12), "one two…");
  EXPECT_EQ(oneLine("one two three", 7), "one two…");
  EXPECT_EQ(oneLine("ääää", 3), "ä…");  // two bytes each: characters are not split
}

TEST(WithoutSecrets, MasksPasswordsOfConnections) {
  EXPECT_EQ(withoutSecrets("PG:dbname=x user=u password=top port=1"), "PG:dbname=x user=u password=*** port=1");
  EXPECT_EQ(withoutSecrets("PG:PASSWORD = 'to\\'p secret' host=h"), "PG:PASSWORD = *** host=h");
  EXPECT_EQ(withoutSecrets("MYSQL:x,password=top,host=h"), "MYSQL:x,password=***,host=h");
  EXPECT_EQ(withoutSecrets("MSSQL:server=h;UID=u;PWD={t;op};db=x"), "MSSQL:server=h;UID=u;PWD=***;db=x");
  EXPECT_EQ(withoutSecrets("'PG:host=h password=top': gone"), "'PG:host=h password=***': gone");
  EXPECT_EQ(withoutSecrets("sslpassword=a passwd=b, pwd = \"c d"), "sslpassword=*** passwd=***, pwd = ***");
  EXPECT_EQ(withoutSecrets("password="), "password=***");
}

TEST(WithoutSecrets, MasksCredentialsOfUrls) {
  EXPECT_EQ(withoutSecrets("'postgresql://u:top@h:1/x' failed"), "'postgresql://u:***@h:1/x' failed");
  EXPECT_EQ(withoutSecrets("WFS:https://u:t@p@h/x?token=abc&z=1"), "WFS:https://u:***@h/x?token=***&z=1");
  EXPECT_EQ(withoutSecrets("/vsicurl/https://h/x?X-Amz-Signature=ab12"), "/vsicurl/https://h/x?X-Amz-Signature=***");
  EXPECT_EQ(withoutSecrets("a://b:c@d and e://f:g@h"), "a://b:***@d and e://f:***@h");
}

TEST(WithoutSecrets, LeavesOtherTexts) {
  for (const std::string text : {"", "=", "'lake.gpkg': no such file", "https://h:80/a@b?tokens=1&design=2", "x = 3",
                                 "the password is missing", "http://u@h/x", "postgresql://h:1/x"})
    EXPECT_EQ(withoutSecrets(text), text);
}

TEST(Errors, HaveNoSecrets) {
  EXPECT_STREQ(InputError("'PG:password=top': gone").what(), "'PG:password=***': gone");
  EXPECT_STREQ(OutputError("'PG:password=top': gone").what(), "'PG:password=***': gone");
}

TEST(Errors, AreOneLine) {
  EXPECT_STREQ(InputError("a\nb").what(), "a b");
  EXPECT_STREQ(OutputError("a\n\n  b\n").what(), "a b");
}

// SQLite's driver quotes whole statements if the disk is full.
TEST(OgrErrors, GiveOneShortLine) {
  const OgrErrors errors;
  std::string statement = "failed to execute:\n";
  for (int i = 0; i < 1000; ++i) statement += "INSERT INTO t\n";
  CPLError(CE_Failure, CPLE_AppDefined, "%s", statement.c_str());
  EXPECT_TRUE(errors.failed());
  EXPECT_TRUE(errors.text().starts_with("failed to execute: INSERT INTO t INSERT")) << errors.text();
  EXPECT_LT(errors.text().size(), 310u);
  EXPECT_EQ(errors.text().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace coastmesh
