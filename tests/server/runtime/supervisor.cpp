#include "server/runtime/supervisor.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

/// A service manager's end of the socket.
class Manager {
 public:
  explicit Manager(const std::string& name) : descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof address.sun_path);
    if (name.starts_with('@')) address.sun_path[0] = '\0';
    const std::size_t size = offsetof(sockaddr_un, sun_path) + name.size() + (name.starts_with('@') ? 0 : 1);
    EXPECT_EQ(::bind(descriptor_, reinterpret_cast<sockaddr*>(&address), static_cast<socklen_t>(size)), 0)
        << std::strerror(errno);
  }
  ~Manager() { ::close(descriptor_); }
  /// The next datagram, empty where none has come.
  std::string next() const {
    char bytes[512];
    const ssize_t size = ::recv(descriptor_, bytes, sizeof bytes, MSG_DONTWAIT);
    return size < 0 ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
  }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

struct SupervisorTest : testing::Test {
  SupervisorTest() {
    char name[] = "/tmp/supervisor_test.XXXXXX";
    folder = ::mkdtemp(name);
  }
  ~SupervisorTest() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder;
};

TEST_F(SupervisorTest, TellsAPathWhatHappens) {
  const std::string name = folder / "notify";
  const Manager manager(name);
  const Supervisor supervisor(name);
  EXPECT_TRUE(supervisor.present());
  EXPECT_TRUE(supervisor.ready("serving on [::1]:8080"));
  EXPECT_EQ(manager.next(), "READY=1\nSTATUS=serving on [::1]:8080");
  EXPECT_TRUE(supervisor.alive());
  EXPECT_EQ(manager.next(), "WATCHDOG=1");
  EXPECT_TRUE(supervisor.stopping("draining", 1250ms));
  EXPECT_EQ(manager.next(), "STOPPING=1\nSTATUS=draining\nEXTEND_TIMEOUT_USEC=1250000");
  EXPECT_EQ(manager.next(), "");
}

TEST_F(SupervisorTest, TellsAnAbstractName) {
  const std::string name = "@bahnwerk-supervisor-test-" + std::to_string(::getpid());
  const Manager manager(name);
  EXPECT_TRUE(Supervisor(name).alive());
  EXPECT_EQ(manager.next(), "WATCHDOG=1");
}

TEST_F(SupervisorTest, AStatusIsOneLine) {
  const std::string name = folder / "notify";
  const Manager manager(name);
  EXPECT_TRUE(Supervisor(name).ready("a\nMAINPID=1"));
  EXPECT_EQ(manager.next(), "READY=1\nSTATUS=a MAINPID=1");
}

TEST_F(SupervisorTest, IsSilentWithoutAManager) {
  const std::string beyond(200, 'x');
  for (const std::string& name : {std::string(), std::string("relative/path"), "/" + beyond, "@" + beyond}) {
    const Supervisor supervisor(name, 1s);
    EXPECT_FALSE(supervisor.present()) << name;
    EXPECT_FALSE(supervisor.heartbeat()) << name;
    EXPECT_FALSE(supervisor.ready("")) << name;
  }
  const Supervisor gone((folder / "nobody").string());
  EXPECT_TRUE(gone.present());
  EXPECT_FALSE(gone.alive()) << "nobody is bound to that path";
}

TEST_F(SupervisorTest, TakesTheLongestNamesThatAnAddressHolds) {
  const std::string name = "@" + std::string(sizeof(sockaddr_un::sun_path) - 1, 'b');
  const Manager manager(name);
  EXPECT_TRUE(Supervisor(name).alive());
  EXPECT_EQ(manager.next(), "WATCHDOG=1");
  EXPECT_FALSE(Supervisor(name + "b").present());
  EXPECT_TRUE(Supervisor("/" + std::string(sizeof(sockaddr_un::sun_path) - 2, 'b')).present());
  EXPECT_FALSE(Supervisor("/" + std::string(sizeof(sockaddr_un::sun_path) - 1, 'b')).present());
}

TEST_F(SupervisorTest, AFullSocketHoldsNobodyUp) {
  const std::string name = folder / "notify";
  const Manager manager(name);
  const Supervisor supervisor(name);
  int told = 0;
  while (told < 1'000'000 && supervisor.alive()) ++told;
  EXPECT_GT(told, 0);
  EXPECT_LT(told, 1'000'000) << "nobody reads, so the queue fills";
  EXPECT_EQ(manager.next(), "WATCHDOG=1");
  EXPECT_TRUE(supervisor.alive()) << "there is room again";
}

TEST_F(SupervisorTest, HeartbeatIsHalfOfTheWatchdog) {
  const std::string name = folder / "notify";
  EXPECT_EQ(Supervisor(name, 30s).heartbeat(), 15000ms);
  EXPECT_EQ(Supervisor(name, 500us).heartbeat(), 1ms) << "a wait of nothing would take a processor";
  EXPECT_FALSE(Supervisor(name, 0us).heartbeat());
}

TEST(WatchdogInterval, CountsForTheWatchedProcessAlone) {
  EXPECT_EQ(watchdog_interval("30000000", "17", 17), 30s);
  EXPECT_EQ(watchdog_interval("30000000", nullptr, 17), 30s);
  EXPECT_EQ(watchdog_interval("30000000", "18", 17), 0us);
  EXPECT_EQ(watchdog_interval("30000000", "x", 17), 0us);
  for (const char* none : {static_cast<const char*>(nullptr), "", "0", "-1", "30s", "99999999999999999999"})
    EXPECT_EQ(watchdog_interval(none, nullptr, 17), 0us) << (none ? none : "not set");
}

}  // namespace
}  // namespace bahnwerk::server
