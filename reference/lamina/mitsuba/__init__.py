"""Leaves, lights and maps of Lamina's in Mitsuba 3, for scenes by `lamina export mitsuba`.

    from lamina.mitsuba import variant

    variant.choose()
    import mitsuba as mi
    from lamina.mitsuba import plugins

    plugins.register()
    mi.load_file("exported/scene.xml")

`variant.choose()` comes first: all other modules are bound to the variant that is set when they are
imported.
"""
