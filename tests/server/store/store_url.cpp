#include "server/store/store_url.hpp"

#include <gtest/gtest.h>

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

TEST(StoreUrl, NamesItsStore) {
  EXPECT_TRUE(names_postgres("postgresql://host/db"));
  EXPECT_TRUE(names_postgres("postgres://host/db"));
  EXPECT_FALSE(names_postgres("sqlite:postgres://x"));
  EXPECT_FALSE(names_postgres("postgresql:x"));
}

}  // namespace
}  // namespace bahnwerk::server
