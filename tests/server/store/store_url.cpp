#include "server/store/store_url.hpp"

#include <fstream>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

TEST(StoreUrl, IsPrintedWithoutPasswords) {
  EXPECT_EQ(without_secrets("sqlite:var/a:b@c.db"), "sqlite:var/a:b@c.db");
  EXPECT_EQ(without_secrets("postgresql://host/db"), "postgresql://host/db");
  EXPECT_EQ(without_secrets("postgresql://me@host:5432/db"), "postgresql://me@host:5432/db");
  EXPECT_EQ(without_secrets("postgresql://me:secret@host:5432/db"), "postgresql://me@host:5432/db");
  EXPECT_EQ(without_secrets("postgresql://me:se@cr/et@host/db?a=1"), "postgresql://me@host/db?a=1");
  EXPECT_EQ(without_secrets("postgres://h/d?password=x&sslmode=require&sslpassword=y"),
            "postgres://h/d?sslmode=require");
  EXPECT_EQ(without_secrets("postgres://h/d?sslmode=require&password=x"), "postgres://h/d?sslmode=require");
  EXPECT_EQ(without_secrets("postgres:///?host=/run&user=me&password=x"), "postgres:///?host=/run&user=me");
}

TEST(StoreUrl, TakesThePasswordFromTheFirstLineOfAFile) {
  const TempFolder folder;
  const std::string file = (folder.path / "password").string();
  std::ofstream(file) << "p@ss wörd\nmore\n";
  const std::string url = with_password("postgresql://me@host/db?sslmode=require", file);
  EXPECT_EQ(url, "postgresql://me@host/db?sslmode=require&password=%70%40%73%73%20%77%C3%B6%72%64");
  EXPECT_EQ(without_secrets(url), "postgresql://me@host/db?sslmode=require");
  EXPECT_EQ(without_secrets(with_password("postgresql://me@host/db", file)), "postgresql://me@host/db");
  EXPECT_THROW(with_password("sqlite:a.db", file), StoreError);
  EXPECT_THROW(with_password("postgresql://me@host/db", file + "2"), StoreError);
}

TEST(StoreUrl, NamesItsStore) {
  EXPECT_TRUE(names_postgres("postgresql://host/db"));
  EXPECT_TRUE(names_postgres("postgres://host/db"));
  EXPECT_FALSE(names_postgres("sqlite:postgres://x"));
  EXPECT_FALSE(names_postgres("postgresql:x"));
}

}  // namespace
}  // namespace bahnwerk::server
