@echo off
rem Starts Candela with the newest JDK on this machine, 17 or later.
rem   CANDELA_JAVA  folder of the JDK to use instead
rem   JAVA_OPTS     additional JVM options, such as -Xmx4g
setlocal EnableExtensions
for %%L in ("%~dp0..\lib") do set "LIB=%%~fL"
set "BEST=0"
set "HOME_FOUND="
if defined CANDELA_JAVA (
  call :consider "%CANDELA_JAVA%"
) else (
  if defined JAVA_HOME call :consider "%JAVA_HOME%"
  for %%F in ("%ProgramFiles%\Java" "%ProgramFiles%\Eclipse Adoptium" "%ProgramFiles%\Microsoft" ^
    "%ProgramFiles%\Amazon Corretto" "%ProgramFiles%\Zulu" "%USERPROFILE%\.jdks") do (
    for /d %%D in ("%%~F\*") do call :consider "%%~D"
  )
)
if %BEST% LSS 17 (
  echo candela: no JDK 17 or newer found. 1>&2
  echo candela: Install one, for example from https://adoptium.net, or set CANDELA_JAVA to its folder. 1>&2
  exit /b 2
)
set "NATIVES=windows-x64"
if /i "%PROCESSOR_ARCHITECTURE%"=="ARM64" set "NATIVES=windows-arm64"
rem Since JDK 19, Java maintains the class-data archive itself.
set "ARCHIVE=-Dcandela.archive=none"
if %BEST% GEQ 19 if defined LOCALAPPDATA (
  if not exist "%LOCALAPPDATA%\candela" mkdir "%LOCALAPPDATA%\candela" 2>nul
  set "ARCHIVE=-XX:+AutoCreateSharedArchive -XX:SharedArchiveFile="%LOCALAPPDATA%\candela\classes-%BEST%.jsa" -Xlog:cds*=off"
)
"%HOME_FOUND%\bin\java.exe" %ARCHIVE% "@%LIB%\options" "-Dorg.lwjgl.librarypath=%LIB%\natives\%NATIVES%" %JAVA_OPTS% -cp "%LIB%\candela.jar" candela.cli.Main %*
exit /b %ERRORLEVEL%

:consider
if not exist "%~1\bin\java.exe" exit /b 0
if not exist "%~1\release" exit /b 0
for /f "tokens=2 delims==" %%V in ('findstr /b "JAVA_VERSION=" "%~1\release"') do (
  for /f "delims=.-+ " %%M in ("%%~V") do if %%M GTR %BEST% (
    set "BEST=%%M"
    set "HOME_FOUND=%~1"
  )
)
exit /b 0
