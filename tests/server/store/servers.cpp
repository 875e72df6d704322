#include "server/store/postgres/servers.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

using Strings = std::vector<std::string>;

TEST(PostgresServers, OneServerIsNamedByItsParameters) {
  const PostgresServers servers = servers_of("postgresql://user:it's@db/plans?application_name=x");
  EXPECT_EQ(servers.each, Strings{R"(user='user' password='it\'s' dbname='plans' application_name='x' host='db')"});
  EXPECT_FALSE(servers.written);
}

TEST(PostgresServers, EachServerGetsItsHostAndPort) {
  const PostgresServers servers = servers_of("postgresql://db1,db2:5433/plans?target_session_attrs=read-write");
  EXPECT_EQ(servers.each, (Strings{"dbname='plans' host='db1' port=''", "dbname='plans' host='db2' port='5433'"}));
  EXPECT_TRUE(servers.written);
  EXPECT_EQ(servers_of("host=/a,/b port=1 target_session_attrs=standby").each,
            (Strings{"target_session_attrs='standby' host='/a' port='1'",
                     "target_session_attrs='standby' host='/b' port='1'"}));
  EXPECT_TRUE(servers_of("hostaddr=::1 target_session_attrs=primary").written);
}

TEST(PostgresServers, WhatIsNotUnderstoodIsLeftToTheLibrary) {
  for (const std::string url : {"nonsense", "host=a,b,c port=1,2", "host=a,b target_session_attrs=prefer-standby"}) {
    EXPECT_EQ(servers_of(url).each, Strings{url});
    EXPECT_FALSE(servers_of(url).written);
  }
}

}  // namespace
}  // namespace bahnwerk::server
