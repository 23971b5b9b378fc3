#include "dds/identity_check.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509_vfy.h>

#include <fstream>
#include <memory>
#include <sstream>

namespace laneloom::dds {
namespace {

template <auto free>
struct Free {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};
using File = std::unique_ptr<BIO, Free<BIO_free_all>>;
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Store = std::unique_ptr<X509_STORE, Free<X509_STORE_free>>;
using Verification = std::unique_ptr<X509_STORE_CTX, Free<X509_STORE_CTX_free>>;
using Signed = std::unique_ptr<PKCS7, Free<PKCS7_free>>;

File open(const std::filesystem::path& file) { return File(BIO_new_file(file.c_str(), "r")); }

Certificate certificate(const std::filesystem::path& file) {
  return Certificate(PEM_read_bio_X509(open(file).get(), nullptr, nullptr, nullptr));
}

/// A store that trusts all certificates of this authority.
Store trusting(const Certificate& authority) {
  Store store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority.get());
  return store;
}

std::string certificate_problem(const std::filesystem::path& folder) {
  const Certificate authority = certificate(folder / "identity_ca.cert.pem");
  if (!authority) return "identity_ca.cert.pem is no certificate";
  const Certificate own = certificate(folder / "cert.pem");
  if (!own) return "cert.pem is no certificate";
  const Store store = trusting(authority);
  const Verification verification(X509_STORE_CTX_new());
  X509_STORE_CTX_init(verification.get(), store.get(), own.get(), nullptr);
  if (X509_verify_cert(verification.get()) != 1)
    return std::string("cert.pem: ") +
           X509_verify_cert_error_string(X509_STORE_CTX_get_error(verification.get()));
  const Key key(PEM_read_bio_PrivateKey(open(folder / "key.pem").get(), nullptr, nullptr, nullptr));
  if (!key) return "key.pem is no private key";
  return X509_check_private_key(own.get(), key.get()) == 1 ? "" : "key.pem is not the key of cert.pem";
}

std::string signature_problem(const std::filesystem::path& folder, const std::string& name) {
  const Certificate authority = certificate(folder / "permissions_ca.cert.pem");
  if (!authority) return "permissions_ca.cert.pem is no certificate";
  BIO* text = nullptr;
  const Signed message(SMIME_read_PKCS7(open(folder / name).get(), &text));
  const File content(text);
  if (!message) return name + " is not signed, or cut off";
  const Store store = trusting(authority);
  if (PKCS7_verify(message.get(), nullptr, store.get(), content.get(), nullptr, PKCS7_TEXT) == 1) return {};
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  return name + ": " + (reason == nullptr ? "not believed" : reason);
}

}  // namespace

std::string identity_problem(const std::filesystem::path& folder) {
  std::string problem = certificate_problem(folder);
  for (const char* const name : {"governance.p7s", "permissions.p7s"})
    if (problem.empty()) problem = signature_problem(folder, name);
  ERR_clear_error();
  return problem;
}

bool governance_protects_messages(const std::filesystem::path& folder) {
  std::ostringstream signed_text;  // Fast DDS checks the signature
  signed_text << std::ifstream(folder / "governance.p7s").rdbuf();
  const std::string text = signed_text.str();
  const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
  return has("<rtps_protection_kind>") && !has("<rtps_protection_kind>NONE") &&
         !has("<allow_unauthenticated_participants>true") && !has("<allow_unauthenticated_participants>TRUE");
}

}  // namespace laneloom::dds
