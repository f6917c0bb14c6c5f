// A bracketed string of modules as two packed streams: a symbol each (2 bytes), and their parameters one
// after the other (8 bytes each, numbers of Lua). A module with one parameter takes 10 bytes; where its
// parameters start follows from the symbols before it.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include <espalier/lsystem/strings/symbols.h>

namespace espalier::lsystem {

/// An array that grows by realloc: large ones move by pages, not by copying, and memory that was never
/// written takes none. Contents start undefined.
template <typename T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer() { std::free(data_); }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  void clear() { size_ = 0; }
  void truncate(std::size_t size) { size_ = size; }
  void push_back(T value) { *grow(1) = value; }

  /// Makes room for `count` more and returns where they go.
  T* grow(std::size_t count) {
    if (size_ + count > capacity_) reserve((size_ + count) + (size_ + count) / 4 + 64);
    T* place = data_ + size_;
    size_ += count;
    return place;
  }
  /// Copies `count` values to the end; they must not be this buffer's own.
  void append(const T* values, std::size_t count) {
    if (count > 0) std::memcpy(grow(count), values, count * sizeof(T));
  }
  /// Gives back what growing took in advance.
  void fit() {
    if (size_ > 0 && size_ < capacity_) reserve(size_);
  }
  void swap(Buffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

 private:
  void reserve(std::size_t capacity) {
    void* moved = std::realloc(data_, capacity * sizeof(T));
    if (!moved) throw std::bad_alloc();
    data_ = static_cast<T*>(moved);
    capacity_ = capacity;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

struct ModuleString {
  Buffer<SymbolId> symbols;
  Buffer<double> values;  ///< NaN where undefined: parameters of query modules before the turtle has run

  std::size_t size() const { return symbols.size(); }
  void clear() {
    symbols.clear();
    values.clear();
  }
  std::size_t memory_bytes() const {
    return symbols.capacity() * sizeof(SymbolId) + values.capacity() * sizeof(double);
  }
};

/// "F(1)?P(0,1)-A": at most six digits, "*" for an undefined parameter.
std::string to_text(const ModuleString& string, const SymbolTable& alphabet);

/// One module, as to_text writes it.
std::string module_text(const Symbol& symbol, const double* values);

}  // namespace espalier::lsystem
