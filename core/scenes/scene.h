#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/scenes/animation.h"
#include "catena/core/parameters/parameters.h"

namespace catena {

/// What a scene file says of itself. `n`, `radius`, `spacing`, `align`, `offset`, `scale` are declared for
/// every scene by the registry (SceneSetup); a scene declares its own parameters and may override a default.
struct SceneInfo {
  std::string name;     ///< "path1"
  std::string summary;  ///< one line for `catena list`
  std::vector<ParameterInfo> parameters;
  /// Why it is hard on arithmetic or on a hierarchy; empty for an ordinary scene. A scene that strains
  /// something may leave the conventions of the others: radii that differ, coordinates far from the origin.
  std::string strains = {};
  /// Settings from mild to hard ("margin=1e-2"), without n; the stability matrix runs them all. Empty: the
  /// defaults alone.
  std::vector<std::string> settings = {};
};

/// All scenes of the program, self-registered before main.
class SceneRegistry {
 public:
  using Make = std::function<std::unique_ptr<Animation>(const Parameters&)>;
  static SceneRegistry& instance();
  void add(SceneInfo info, Make make);
  std::vector<SceneInfo> scenes() const;  ///< sorted by name
  bool contains(std::string_view name) const;
  /// Opens "name" or "name:key=value,...". Throws InputError naming what is unknown and what there is.
  std::unique_ptr<Animation> open(std::string_view spec) const;

 private:
  struct Entry {
    SceneInfo info;
    Make make;
  };
  std::map<std::string, Entry, std::less<>> entries_;
};

/// One object of this at namespace scope registers a scene file.
struct RegisterScene {
  RegisterScene(SceneInfo info, SceneRegistry::Make make) {
    SceneRegistry::instance().add(std::move(info), std::move(make));
  }
};

}  // namespace catena
