// A client that sends any bytes, valid or not, and reads the reply.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/files/json.h"

namespace chironomia::testing {

struct RawAnswer {
    int status = 0;
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;

    Json json() const { return Json::parse(body); }
};

class RawClient {
  public:
    // Connects to this machine, from one of its own addresses (127.x.y.z); connected() says whether that
    // worked.
    explicit RawClient(int port, const std::string& from = "127.0.0.1");
    ~RawClient();
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool connected() const { return socket_ >= 0; }

    // False if the server does not take all of it.
    bool send(const std::string& bytes);

    // The next answer; nothing if the connection ends before all of it is there, or for 30 s nothing comes.
    std::optional<RawAnswer> read(bool without_body = false);

    // All that comes until the server closes the connection.
    std::string read_all();

    std::optional<RawAnswer> get(const std::string& path, const std::string& headers = "");
    std::optional<RawAnswer> post(const std::string& path, const Json& body);

  private:
    bool receive();

    int socket_ = -1;
    std::string unread_;
};

// A whole request with a JSON body.
std::string post_text(const std::string& path, const std::string& body,
                      const std::string& type = "application/json");

}  // namespace chironomia::testing
