// A web server on 127.0.0.1 that breaks off: for the test of resumed downloads.
//
//   flaky_http_server FOLDER CUT_BYTES [--no-ranges]
//
// Serves the files of FOLDER. Each response ends, connection closed, after at most CUT_BYTES bytes of content
// (0: whole files), though its header promises all that were asked for. Prints its port, then a line "PATH
// FIRST_BYTE" for each request.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace {

std::string read_request(int connection) {
  std::string request;
  char buffer[4096];
  while (request.find("\r\n\r\n") == std::string::npos) {
    const ssize_t count = read(connection, buffer, sizeof buffer);
    if (count <= 0) break;
    request.append(buffer, static_cast<std::size_t>(count));
  }
  return request;
}

void send_all(int connection, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = send(connection, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

void answer(int connection, const std::string& folder, std::size_t cut_bytes, bool ranges) {
  const std::string request = read_request(connection);
  const std::string path = request.substr(4, request.find(' ', 4) - 4);  // behind "GET "
  const auto range = request.find("Range: bytes=");
  const std::size_t first =
      range == std::string::npos ? 0 : std::strtoull(request.c_str() + range + 13, nullptr, 10);
  std::cout << path << ' ' << first << std::endl;

  std::ifstream file(folder + path, std::ios::binary);
  if (!file) return send_all(connection, "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n");
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::string size = std::to_string(content.size());
  const bool partial = ranges && range != std::string::npos;
  if (partial && first >= content.size())
    return send_all(connection, "HTTP/1.1 416 Range Not Satisfiable\r\nContent-Range: bytes */" + size +
                                    "\r\nContent-Length: 0\r\n\r\n");
  const std::string rest = partial ? content.substr(first) : content;
  std::string header = partial
                           ? "HTTP/1.1 206 Partial Content\r\nContent-Range: bytes " + std::to_string(first) +
                                 "-" + std::to_string(content.size() - 1) + "/" + size + "\r\n"
                           : "HTTP/1.1 200 OK\r\n";
  header += "Content-Length: " + std::to_string(rest.size()) + "\r\nConnection: close\r\n\r\n";
  send_all(connection, header + rest.substr(0, cut_bytes > 0 ? cut_bytes : rest.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(listener, generic, length) != 0 || listen(listener, 8) != 0) return 1;
  getsockname(listener, generic, &length);
  std::cout << ntohs(address.sin_port) << std::endl;
  while (true) {
    const int connection = accept(listener, nullptr, nullptr);
    if (connection < 0) return 1;
    answer(connection, argv[1], std::strtoull(argv[2], nullptr, 10), argc < 4);
    close(connection);
  }
}
