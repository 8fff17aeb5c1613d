// A plug-in as it was compiled when the classes of dodge/ were others.
extern "C" unsigned long dodge_plugin_interface() { return 1; }
extern "C" void* dodge_plugin_pilot(const void*, const void*) { return nullptr; }
